// The packets that a tile of pixels is traced by.
#pragma once

#include "csgcore/view.hpp"
#include "rays/make_rays.hpp"

namespace csgcore {

/// What the screen is divided into.
using Tile = PixelArea;

/// A packet that is a block of pixels from (x, y) on.
struct PacketBlock {
  uint32_t x, y;
  LaneMask lanes;  // those within the picture
};

/// Lanes of a block that lie within so many pixels.
inline LaneMask lanes_within(uint32_t width, uint32_t height) {
  if (width >= kPacketWidth_px && height >= kPacketHeight_px) return kAllLanes;
  LaneMask lanes = 0;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const bool within = lane % kPacketWidth_px < width && lane / kPacketWidth_px < height;
    lanes |= LaneMask{within} << lane;
  }
  return lanes;
}

/// Calls back with each PacketBlock of the tile, row by row.
template <typename Visit>
void for_each_block(const Tile& tile, Visit&& visit) {
  for (uint32_t y = 0; y < tile.height; y += kPacketHeight_px) {
    for (uint32_t x = 0; x < tile.width; x += kPacketWidth_px) {
      const LaneMask lanes = lanes_within(tile.width - x, tile.height - y);
      visit(PacketBlock{tile.x + x, tile.y + y, lanes});
    }
  }
}

/// The rays through the centres of a block's pixels.
inline void make_block_rays(const FrameRays& frame, const PacketBlock& block, RayPacket& rays) {
  make_block_rays(frame, block.x, block.y, rays);
}

}  // namespace csgcore
