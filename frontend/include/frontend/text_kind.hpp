// The kinds of text that the command writes of an evaluated design.
#pragma once

#include <cstdint>

namespace frontend {

/// What `openscad -o` writes of a design as text.
enum class TextKind : uint8_t {
  kCsg,    // its tree
  kEcho,   // the messages of its evaluation
  kParam,  // what its user can choose, as JSON
};

}  // namespace frontend
