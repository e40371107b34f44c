#include "volume.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "csgcore/tracer.hpp"
#include "ray_judge.hpp"
#include "samples.hpp"

namespace validation {
namespace {

using csgcore::Vec3;
using csgcore::View;

struct Chord {
  double length = 0;  // length of the chord within the solid
  uint64_t crossings = 0;
};

/// Traces a ray straight up from below the solid, from one crossing to the next.
Chord chord_at(const csgcore::Subdivision& subdivision, double x, double y) {
  const csgcore::Box& box = subdivision.solid().bounds();
  View view;
  view.projection = csgcore::Projection::kPerspective;
  view.width_px = view.height_px = 1;
  view.half_height = 1e-3;  // the only pixel's centre is on the axis, however wide the pixel is
  view.right = Vec3(1, 0, 0);
  view.up = Vec3(0, -1, 0);
  view.forward = Vec3(0, 0, 1);
  view.eye = Vec3(x, y, box.min.z - box.diagonal());
  Chord chord;
  // A ray sees nothing that is nearer than the thickness tolerance, so that it gets on with each
  // crossing, unless its place is so far from the origin that rounding swallows the step.
  for (;;) {
    const Seen seen = traced_ray(subdivision, view);
    if (!seen.hit() || !(view.eye.z + seen.s > view.eye.z)) break;
    ++chord.crossings;
    if (glm::dot(seen.normal, view.forward) > 0) chord.length += seen.s;
    view.eye.z += seen.s;
  }
  return chord;
}

/// The estimate of one grid.
struct Pass {
  double volume = 0;
  double variance = 0;  // of the volume
  double hidden = 0;    // volume that the thickness tolerance may hide
};

Pass trace_grid(const csgcore::Subdivision& subdivision, uint64_t side, uint64_t seed,
                uint64_t first_ray) {
  const csgcore::Box& box = subdivision.solid().bounds();
  const Vec3 square = box.size() / static_cast<double>(side);
  std::vector<Chord> chords(2 * side * side);
  tbb::parallel_for(tbb::blocked_range<uint64_t>(0, chords.size()), [&](const auto& range) {
    for (uint64_t i = range.begin(); i < range.end(); ++i) {
      Random random(seed, Random::Use::kVolume, first_ray + i);
      const uint64_t cell = i / 2;
      const double column = static_cast<double>(cell % side) + random.uniform();
      const double row = static_cast<double>(cell / side) + random.uniform();
      chords[i] = chord_at(subdivision, box.min.x + column * square.x, box.min.y + row * square.y);
    }
  });
  const double area = square.x * square.y;
  Pass pass;
  for (std::size_t i = 0; i < chords.size(); i += 2) {
    const Chord &a = chords[i], &b = chords[i + 1];
    const double difference = area * (a.length - b.length) / 2;
    pass.volume += area * (a.length + b.length) / 2;
    pass.variance += difference * difference;
    pass.hidden += area * csgcore::thickness_tolerance(box) *
                   static_cast<double>(std::max(a.crossings, b.crossings));
  }
  return pass;
}

}  // namespace

VolumeEstimate estimate_volume(const csgcore::Subdivision& subdivision, uint64_t seed,
                               uint64_t rays, Clock::time_point deadline,
                               const Progress& progress) {
  constexpr double kLeastSide = 16;  // with fewer squares the error could not be told
  constexpr double kStandardErrors = 5;
  const double pairs = static_cast<double>(std::min(rays, kVolumePass)) / 2;
  const auto side = static_cast<uint64_t>(std::max(kLeastSide, std::ceil(std::sqrt(pairs))));
  Pass sum;
  uint64_t passes = 0, traced = 0;
  do {
    const Pass pass = trace_grid(subdivision, side, seed, traced);
    sum.volume += pass.volume;
    sum.variance += pass.variance;
    sum.hidden += pass.hidden;
    ++passes;
    traced += 2 * side * side;
    progress("volume", static_cast<double>(traced) / static_cast<double>(rays));
  } while (traced < rays && Clock::now() < deadline);
  // A part that a ray meets with probability p is missed by n rays with probability (1 − p)ⁿ: less
  // than one in a million for p ≥ 14/n.
  constexpr double kUnseen = 14;
  const Vec3 extent = subdivision.solid().bounds().size();
  const double unseen = kUnseen / static_cast<double>(traced) * extent.x * extent.y * extent.z;
  const auto count = static_cast<double>(passes);
  return {sum.volume / count,
          (kStandardErrors * std::sqrt(sum.variance) + sum.hidden) / count + unseen, traced};
}

}  // namespace validation
