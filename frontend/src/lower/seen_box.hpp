// The box of a solid, found by looking at it: the operations may leave less than their operands'
// boxes tell.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// The pixels along a side of the first look at a solid, which finds what sticks out.
constexpr uint32_t kOverviewOfDesign_px = 256;
constexpr uint32_t kOverviewOfLeaf_px = 96;  // a look takes a seventh of the time

/// The box of the corners of the tight box that the solid has in its own frame. It is within 1e-5
/// of the solid's size, but for what is thinner than a pixel of the first look and may be missed.
/// Empty where nothing of the solid is seen.
csgcore::Box seen_box(std::span<const csgcore::Primitive> primitives, const csgcore::CsgTree& solid,
                      const csgcore::Affine& frame_to_world, uint32_t overview_px);

}  // namespace frontend
