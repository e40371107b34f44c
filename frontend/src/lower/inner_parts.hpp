// The parts of a hull, a Minkowski sum or a resize() that are drawn beside it, or over it.
#pragma once

#include <cstdint>
#include <vector>

#include "lower/plane_subtree.hpp"

namespace frontend {

/// A node with `%` or `#` inside of such a node.
struct InnerPart {
  uint32_t node;
  std::vector<uint32_t> matrices;  // the multmatrix nodes around it, from the root's on
};

/// Returns those that OpenSCAD's preview shows: none of other roots, and none inside of extrusions,
/// offset() and render().
std::vector<InnerPart> inner_parts(const PlaneSubtree& subtree);

}  // namespace frontend
