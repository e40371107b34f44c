// The primitive that makes a solid solid at a point.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "csgcore/csg_tree.hpp"

namespace window {

/// Returns the first primitive of the tree that the point lies in and that no operation takes away
/// there: what a cut through the solid shows. Nothing if the point is outside of the solid.
/// `contains` tells which primitives the point lies in.
std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains);

}  // namespace window
