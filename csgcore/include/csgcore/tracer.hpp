// The CPU ray tracer: exact pictures in double, by SIMD packets of rays (NUMERICS.md says how
// exact).
//
// Two structures tell a ray what it can meet; both hand lists of tests to the same evaluation,
// and both make the same picture:
// - tiles: per frame, the screen is divided like a kd-tree, down to tiles of 8 pixels, and the
//   solid's list is restricted to each. Nothing is built in world space: the fastest first picture.
// - the kd-tree of a Subdivision (paper §2), traversed front to back by each packet: built once, it
//   pays for many frames of a dense model.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/hits.hpp"
#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tolerance.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

struct TraceOptions {
  /// Worker threads; 0: as many as there are. The picture does not depend on it.
  unsigned threads = 0;
  /// Rays per pixel where neighbouring pixels show an edge, 1 elsewhere; deterministic. 1: none.
  /// The measured channels are always those of the pixel's centre.
  uint32_t samples = 1;
  Boundary boundary = Boundary::kFirst;
  /// Trace these pixels only, which lie within the view; none: all. `image` or `hits` come from the
  /// same view, settings, samples and boundary, and keep all other pixels: the picture is the whole
  /// one, bit for bit, if the solid has since changed nowhere else (changed_areas.hpp).
  /// With more than one sample the pixels beside the area are looked at too, which it may have made
  /// edges of, or no longer edges.
  std::optional<PixelArea> area;
  /// In place of thickness_tolerance() of the solid's bounds: that of a renderer whose pixels are
  /// traced anew. World units, > 0; no more than 2⁻²⁰ of the size of these bounds.
  std::optional<double> thickness_tolerance;
  /// Find out why primitives were skipped (TraceStats::skipped); costs a little. Of an area that is
  /// not the whole picture, what only others show is counted as cancelled.
  bool count_skipped = false;
  /// Where it asks for it, the frame ends early: what is left undrawn is undefined.
  std::stop_token stop{};
};

/// Primitives of the solid that were never intersected with any ray, by the reason.
struct SkippedPrimitives {
  uint64_t off_screen = 0;  // their bounds miss the picture
  uint64_t sub_pixel = 0;   // they fall between the samples
  uint64_t cancelled = 0;   // where they are, the operations leave nothing, or a later equal one
  uint64_t inside = 0;      // they lie within the solid
  uint64_t hidden = 0;      // they lie behind what is seen
};

/// Of one frame. Times in ms.
struct TraceStats {
  uint64_t primitives = 0;     // that the solid's tree names; this and the next two if counted
  uint64_t intersected = 0;    // of them, those that any ray was intersected with
  SkippedPrimitives skipped;   // the rest
  uint64_t tiles = 0;          // tiles that were traced; 0 with a Subdivision
  uint64_t rays = 0;           // rays that had anything to meet
  uint64_t intersections = 0;  // of a ray with a primitive
  uint64_t resolved_rays = 0;  // rays on which crossings coincide, or nearly
  uint64_t edge_pixels = 0;    // pixels with more than one sample
  double cull_ms = 0;          // bounds of the primitives on the screen
  double trace_ms = 0;         // all the rest
};

/// What an image with measured channels shows, in floats. Primitives are found by their ids: those
/// of the scene that was drawn.
Hits hits_of(const Image& image, const Scene& scene);

/// Traces the solid by screen tiles.
void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats);
void trace(const Solid& solid, const View& view, const TraceOptions& options, Hits& hits,
           TraceStats& stats);

/// The same by a kd-tree. Cells that it dropped below its threshold are empty.
void draw(const Subdivision& subdivision, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, TraceStats& stats);
void trace(const Subdivision& subdivision, const View& view, const TraceOptions& options,
           Hits& hits, TraceStats& stats);

}  // namespace csgcore
