// The end of a picture in the studio's light (studio_light.hpp): shadows, occlusion and edges.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// StudioSettings::directions and largest_noise of a first picture: fewer directions show in
/// hollows (tests/benchmark/NOTES.md, "The studio's light", has what scenes come to).
constexpr uint32_t kFewDirections = 144;
constexpr double kFewDirectionsNoise = 0.045;

/// What finish_studio() does.
struct StudioSettings {
  // How much each of these shows, from 0, not at all, to 1.
  double shadows = 1;    // of the key light
  double occlusion = 1;  // of what comes from all around
  double edges = 1;      // lines where faces meet or end
  /// The directions of the whole sky that are asked. A quarter as many go to the key light, or
  /// a ninth, but at least 9, if light is shared.
  uint32_t directions = 256;
  /// Whether neighbouring pixels ask parts of them for each other, where the same face goes on:
  /// faster, but occlusion is smoothed over 3 × 3 blocks.
  bool shares_light = true;
  /// Where light is shared: half of the directions are asked at first, and the others if the shares
  /// of the sky that neighbours find let it be off by more than this share, as a mean of all
  /// points. 0: all are asked at once.
  double largest_noise = 0;
  /// Where the picture is made smaller afterwards: the side of the squares of pixels that become
  /// one, which share their light as far as they show the same face. At least 1.
  uint32_t block_px = 1;
  bool shows_any() const { return shadows > 0 || occlusion > 0 || edges > 0; }
  bool operator==(const StudioSettings&) const = default;
};

/// Takes from a solid's picture what the solid hides from its own faces, and draws its edges.
/// `image` was drawn with Shading::kStudio, one ray a pixel and Boundary::kFirst. What has an alpha
/// below 1 keeps its light, and gets lines. `options` may name no area; its samples do not
/// count. Adds to `stats`.
/// A picture that the CPU tracer draws by tiles is better drawn by draw_studio().
void finish_studio(const Solid& solid, const View& view, const StudioSettings& settings,
                   const TraceOptions& options, Image& image, TraceStats& stats);

/// Draws such a picture (Boundary::kFirst, one ray a pixel, no area), and finishes it, by the same
/// rays. Overwrites `stats`.
void draw_studio(const Solid& solid, const View& view, const FrameSettings& frame,
                 const StudioSettings& settings, const TraceOptions& options, Image& image,
                 TraceStats& stats);

}  // namespace csgcore
