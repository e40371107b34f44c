// The surfaces of several solids, drawn one over another in one pass over the screen: each part of
// the screen takes all surfaces in their turn. What shows of a surface, where others have been
// drawn before it, is its receiver's matter (SurfaceSink), which can tell in advance what will not.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// A boundary of a solid, and its look.
struct Surface {
  const Solid* solid = nullptr;
  const Subdivision* subdivision = nullptr;  // null: the solid is traced by tiles
  Boundary boundary = Boundary::kFirst;
  FrameSettings frame;  // without a background, and measured channels
};

/// Some of the pixels of a block. The block lies within one square of kSurfaceSquare_px.
struct PixelBlock {
  static constexpr uint32_t kWidth_px = 8, kHeight_px = 4, kPixels = kWidth_px * kHeight_px;
  uint32_t x, y;    // the block's top left pixel
  uint32_t pixels;  // bits: 1 << (column + kWidth_px · row)
};

/// The picture is divided into squares of so many pixels a side, which one thread draws.
constexpr uint32_t kSurfaceSquare_px = 8;

/// What a block's pixels show of a surface.
struct SurfacePixels {
  float z[PixelBlock::kPixels];  // View's s
  std::array<uint8_t, 3> rgb[PixelBlock::kPixels];
  uint32_t id[PixelBlock::kPixels];  // Primitive::id
};

/// Receives surfaces. `turn` is an index in the order in which they are drawn. All threads call it,
/// each for other pixels; for one pixel all calls have an order.
class SurfaceSink {
 public:
  virtual ~SurfaceSink() = default;
  /// Returns whether any pixel of the area may show the surface if it lies nowhere nearer than at
  /// nearest_z. A surface of Boundary::kBehind, if that of kFirst of the same solid follows, is
  /// only asked for where that one shows.
  virtual bool wants(uint32_t turn, const PixelArea& area, float nearest_z) const = 0;
  /// Returns the pixels of the block that may show it then, and by pixel the furthest z at which
  /// they do.
  virtual uint32_t wanted(uint32_t turn, const PixelBlock& block, float nearest_z,
                          double (&furthest_z)[PixelBlock::kPixels]) const = 0;
  /// Returns the pixels of the block that show the surface, which lies at these z.
  virtual uint32_t shown(uint32_t turn, const PixelBlock& block,
                         const float (&z)[PixelBlock::kPixels]) const = 0;
  /// Takes pixels that show it.
  virtual void draw(uint32_t turn, const PixelBlock& block, const SurfacePixels& pixels) = 0;
  /// Is told of an area of whole squares once all that it shows has been drawn.
  virtual void end(const PixelArea&) {}
};

/// Draws surfaces[turns[0]], then surfaces[turns[1]] and so on, with one ray a pixel. Each surface
/// is as draw() of tracer.hpp draws it, bit for bit. `options` may not name an area; its boundary
/// and samples do not count. Overwrites `stats`.
void draw_surfaces(std::span<const Surface> surfaces, std::span<const uint32_t> turns,
                   const View& view, const TraceOptions& options, SurfaceSink& sink,
                   TraceStats& stats);

}  // namespace csgcore
