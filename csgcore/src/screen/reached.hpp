// Finds the rays of a tile that may meet a primitive, by its bounds on the screen.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/extent.hpp"
#include "rays/ray_packet.hpp"
#include "screen/screen_slab.hpp"

namespace csgcore {

/// Finds the lanes that may meet each primitive (indices, whose top bits are ignored) in the block
/// whose top left pixel is (x, y), and in the block below it. It uses the extents on the screen,
/// which must not be NaN, and the slabs of primitives whose extent has inside2 < 0. It holds for
/// rays through pixels' centres only.
void find_reached(const Extent* screen, const ScreenSlab* slabs,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below);

}  // namespace csgcore
