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

/// What --summary tells of a design's solid or plane figure.
struct SummaryParts {
  bool cache = false;
  bool time = false;
  bool camera = false;
  bool geometry = false;
  bool bounding_box = false;
  bool area = false;
  bool any() const { return cache || time || camera || geometry || bounding_box || area; }
};

}  // namespace frontend
