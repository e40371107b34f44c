// The meaning of a design: primitives and the trees over them. All of csgcore works on scenes.
#pragma once

#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/primitive.hpp"

namespace csgcore {

/// The trees hold indices into `primitives`, each of which is valid (is_valid).
struct Scene {
  std::vector<Primitive> primitives;
  CsgTree model;       // the solid
  CsgTree background;  // the union of the `%` parts, drawn separately and translucent
  CsgTree highlight;   // the union of the `#` parts, drawn over the picture and translucent
};

}  // namespace csgcore
