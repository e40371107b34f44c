// The keys that do for the picture what the mouse does.
#pragma once

#include <cstdint>

namespace window {

struct PictureKey {
  enum class Action : uint8_t {
    kTurn,
    kPan,
    kMoveSection,
    kMeasure,
  };
  int key;            // GLFW's number
  uint8_t modifiers;  // of commands.hpp
  Action action;
  int right = 0;  // the direction in the picture: 1, 0 or -1
  int up = 0;     // of the section plane: along its axis
};

/// Returns what a key does; null: nothing. Measuring is done once for each press, the rest again
/// and again while the key is held.
const PictureKey* find_picture_key(int key, uint8_t modifiers);

}  // namespace window
