// The CPU ray tracer: exact pictures in double, by SIMD packets of rays (NUMERICS.md says how
// exact).
//
// One of two structures finds the list of tests that a ray needs; the evaluation of the list is the
// same for both, and so is the picture, bit for bit:
// - tiles: for each frame, the screen is divided like a kd-tree, down to tiles of 8 pixels, and the
//   solid's list is restricted to each tile. Nothing is built in world space, which makes it the
//   fastest way to a first picture.
// - cells: each packet traverses the kd-tree of a Subdivision (paper §2) from front to back. The
//   tree is built once, which pays if many frames of a dense model are drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

struct TraceOptions {
  /// Number of worker threads; 0: as many as there are. The picture does not depend on it.
  unsigned threads = 0;
  /// Rays per pixel where neighbouring pixels show an edge (view.hpp); elsewhere one ray
  /// goes through the pixel's centre. 1: edges are not sampled. The measured channels are always
  /// those of the centre.
  uint32_t samples = 1;
  Boundary boundary = Boundary::kFirst;
  /// The only pixels that are traced, an area within the view; none: all pixels. `image` or `hits`
  /// must hold a picture of the same view, settings, samples and boundary, whose other pixels are
  /// kept. The result equals the whole picture, bit for bit, if the solid has changed nowhere else
  /// since (changed_areas.hpp).
  /// With more than one sample the pixels next to the area are drawn, too, since an edge may have
  /// come or gone there.
  std::optional<PixelArea> area;
  /// Replaces thickness_tolerance() of the solid's bounds, for pixels that are traced on behalf of
  /// another renderer with that tolerance. World units, > 0, at most 2⁻²⁰ of the size of the
  /// bounds.
  std::optional<double> thickness_tolerance;
  /// A stop request ends the frame early, and leaves undefined pixels.
  std::stop_token stop{};
};

/// Statistics of one frame.
struct TraceStats {
  uint64_t tiles = 0;          // traced; 0 with a Subdivision
  uint64_t rays = 0;           // rays that had primitives to be intersected with
  uint64_t intersections = 0;  // of one ray with one primitive each
  uint64_t resolved_rays = 0;  // rays on which crossings coincide, or nearly do
  uint64_t edge_pixels = 0;    // pixels with more than one sample
  double cull_ms = 0;          // for the primitives' bounds on the screen
  double trace_ms = 0;         // for all the rest
};

/// Returns the hits that an image with measured channels shows, in its float precision. `scene` is
/// the one that was drawn: it maps ids to primitives. Throws std::out_of_range at an unknown id.
Hits hits_of(const Image& image, const Scene& scene);

/// These draw the solid into `image`, or store what the pixels' centres see in `hits`, by screen
/// tiles. They overwrite `stats`.
void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats);
void trace(const Solid& solid, const View& view, const TraceOptions& options, Hits& hits,
           TraceStats& stats);

/// These do the same by a kd-tree. Cells that were dropped below its threshold count as empty.
void draw(const Subdivision& subdivision, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats);
void trace(const Subdivision& subdivision, const View& view, const TraceOptions& options,
           Hits& hits, TraceStats& stats);

}  // namespace csgcore
