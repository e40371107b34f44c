// A subtree that OpenSCAD evaluates as a whole, as primitives.
#pragma once

#include <optional>

#include "csgcore/geometry.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

struct LoweredSubtree {
  SolidValue solid;  // of primitives, under the matrices of their frames
  bool is_plate = false;
  bool has_operations = false;      // they are those of nodes of solids
  std::optional<csgcore::Box> box;  // of what the operations leave, where that is known
  /// It is a union, of which OpenSCAD takes the corners of the box in the root's coordinates: `box`
  /// is theirs, and may be larger than the boxes of the parts together.
  bool is_union = false;
};

}  // namespace frontend
