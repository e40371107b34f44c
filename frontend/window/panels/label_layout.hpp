// Where labels stand so that each can be read.
#pragma once

#include <span>
#include <vector>

namespace window {

/// A rectangle of the screen, from its upper left corner, y downwards.
struct LabelBox {
  float x = 0, y = 0, width = 0, height = 0;
};

/// Moves labels into the room, and apart from each other and from the obstacles: up or down, as far
/// as it takes, the earlier ones first. Where there is no such place, a label stays where it is
/// wanted.
void separate(std::span<LabelBox> labels, std::span<const LabelBox> obstacles,
              const LabelBox& room);

}  // namespace window
