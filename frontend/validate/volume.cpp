#include "volume.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "csgcore/tracer.hpp"
#include "random.hpp"
#include "traced_ray.hpp"

namespace validation {
namespace {

using csgcore::Vec3;
using csgcore::View;

struct Chord {
  double length = 0;  // within the solid
  uint64_t crossings = 0;
};

/// Straight up from below the solid: from one crossing to the next, each seen from the last.
Chord chord_at(const csgcore::Subdivision& subdivision, double x, double y) {
  const csgcore::Box& box = subdivision.solid().bounds();
  View view;
  view.projection = csgcore::Projection::kPerspective;
  view.width_px = view.height_px = 1;
  view.half_height = 1e-3;  // the centre of the only pixel is on the axis, however wide it is
  view.right = Vec3(1, 0, 0);
  view.up = Vec3(0, -1, 0);
  view.forward = Vec3(0, 0, 1);
  view.eye = Vec3(x, y, box.min.z - box.diagonal());
  Chord chord;
  // Each primitive is entered and left once at most.
  const uint64_t most_crossings = 2 * subdivision.solid().primitives().size();
  while (chord.crossings < most_crossings) {
    const Seen seen = traced_ray(subdivision, view);
    if (!seen.hit()) break;
    ++chord.crossings;
    if (glm::dot(seen.normal, view.forward) > 0) chord.length += seen.s;
    view.eye.z += seen.s;
  }
  return chord;
}

}  // namespace

VolumeEstimate estimate_volume(const csgcore::Subdivision& subdivision, uint64_t seed,
                               uint64_t rays) {
  constexpr uint64_t kLeastSide = 16;  // fewer squares would not tell the error
  constexpr double kStandardErrors = 5;
  const auto side = std::max(
      kLeastSide, static_cast<uint64_t>(std::lround(std::sqrt(static_cast<double>(rays) / 2))));
  const csgcore::Box& box = subdivision.solid().bounds();
  const Vec3 square = box.size() / static_cast<double>(side);
  std::vector<Chord> chords(2 * side * side);
  tbb::parallel_for(tbb::blocked_range<uint64_t>(0, chords.size()), [&](const auto& range) {
    for (uint64_t i = range.begin(); i < range.end(); ++i) {
      Random random(seed, Random::Use::kVolume, i);
      const uint64_t cell = i / 2;
      const double column = static_cast<double>(cell % side) + random.uniform();
      const double row = static_cast<double>(cell / side) + random.uniform();
      chords[i] = chord_at(subdivision, box.min.x + column * square.x, box.min.y + row * square.y);
    }
  });
  double sum = 0, squares = 0, crossings = 0;
  for (std::size_t i = 0; i < chords.size(); i += 2) {
    const Chord &a = chords[i], &b = chords[i + 1];
    sum += (a.length + b.length) / 2;
    squares += (a.length - b.length) * (a.length - b.length) / 4;
    crossings += static_cast<double>(a.crossings + b.crossings) / 2;
  }
  const double area = square.x * square.y;
  const double hidden = csgcore::thinnest_piece(box) * crossings;
  return {area * sum, area * (kStandardErrors * std::sqrt(squares) + hidden), chords.size()};
}

}  // namespace validation
