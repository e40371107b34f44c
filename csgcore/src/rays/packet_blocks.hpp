// Tiles of pixels, and the packets that trace them.
#pragma once

#include "csgcore/view.hpp"
#include "rays/frame_rays.hpp"

namespace csgcore {

/// A part of the screen, in whole pixels.
using Tile = PixelArea;

/// A packet whose rays are a block of pixels with the top left pixel (x, y).
struct PacketBlock {
  uint32_t x, y;
  LaneMask lanes;  // those within the tile
};

/// Returns the lanes of a block whose columns are below `width` and whose rows are below `height`.
inline LaneMask lanes_within(uint32_t width, uint32_t height) {
  if (width >= kPacketWidth_px && height >= kPacketHeight_px) return kAllLanes;
  LaneMask lanes = 0;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const bool within = lane % kPacketWidth_px < width && lane / kPacketWidth_px < height;
    lanes |= LaneMask{within} << lane;
  }
  return lanes;
}

/// Calls visit(block) with each PacketBlock of the tile, row by row.
template <typename Visit>
void for_each_block(const Tile& tile, Visit&& visit) {
  for (uint32_t y = 0; y < tile.height; y += kPacketHeight_px) {
    for (uint32_t x = 0; x < tile.width; x += kPacketWidth_px) {
      const LaneMask lanes = lanes_within(tile.width - x, tile.height - y);
      visit(PacketBlock{tile.x + x, tile.y + y, lanes});
    }
  }
}

/// Makes the rays through the centres of a block's pixels.
inline void make_block_rays(const FrameRays& frame, const PacketBlock& block, RayPacket& rays) {
  make_block_rays(frame, block.x, block.y, rays);
}

}  // namespace csgcore
