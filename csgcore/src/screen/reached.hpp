// Which of a tile's rays may meet a primitive, by its place on the screen.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/extent.hpp"
#include "rays/ray_packet.hpp"
#include "screen/screen_slab.hpp"

namespace csgcore {

/// Of the primitives (indices, the top bit ignored), the lanes that may meet them in the block from
/// the pixel (x, y) on and in that below it, by their extents on the screen, which are no nan, and
/// the slabs of those whose inside2 < 0. Of rays through pixels' centres only.
void find_reached(const Extent* screen, const ScreenSlab* slabs,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below);

}  // namespace csgcore
