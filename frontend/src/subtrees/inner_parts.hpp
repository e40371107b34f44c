// The parts of a hull, a Minkowski sum or a resize() that are drawn beside it, or over it.
#pragma once

#include <cstdint>
#include <vector>

#include "subtrees/subtree.hpp"

namespace frontend {

/// A `#` part inside a `#` part is overlaid once more, as OpenSCAD does. Beyond so many inside one
/// another no more are added: the overlay would grow with the square of the nesting.
constexpr size_t kMostNestedHighlights = 8;

/// A node inside of such a node that has `%` or `#`, or stands in groups that do.
struct InnerPart {
  uint32_t node;
  uint8_t modifiers;             // CallModifiers % and #, or both
  std::vector<uint32_t> around;  // the multmatrix and color nodes around it, from the root's on
};

/// Returns the leaves of what OpenSCAD's preview shows: of groups their members. None of other
/// roots, and none inside of extrusions, offset() and render().
std::vector<InnerPart> inner_parts(const Subtree& subtree);

}  // namespace frontend
