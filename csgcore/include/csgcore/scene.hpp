// What a design means: primitives and the trees over them. The input of everything in csgcore.
#pragma once

#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/primitive.hpp"

namespace csgcore {

/// All trees index into `primitives`, each of which is valid. Data only.
struct Scene {
  std::vector<Primitive> primitives;
  CsgTree model;       // the solid
  CsgTree background;  // the union of the `%` parts: drawn apart, translucent
  CsgTree highlight;   // the union of the `#` parts: overlaid, translucent
};

}  // namespace csgcore
