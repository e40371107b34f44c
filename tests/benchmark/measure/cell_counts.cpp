#include "cell_counts.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"

namespace measure {
namespace {

using csgcore::Box;
using csgcore::Ray;
using csgcore::Vec3;
using csgcore::View;

/// The number of rays that are followed, from which the average is known to some percent.
constexpr size_t kRays = 400;

bool has_surface(const csgcore::Leaf& leaf) {
  using csgcore::LeafKind;
  return leaf.kind == LeafKind::kUnion || leaf.kind == LeafKind::kPair ||
         leaf.kind == LeafKind::kGeneral || leaf.kind == LeafKind::kFull ||
         leaf.kind == LeafKind::kGivenUp;
}

bool meets(const Ray& ray, const Box& box) {
  double from = -HUGE_VAL, to = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
    const double b = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from < to;
}

/// Tests the bounding rectangle of the box's corners, all of which must be in front of the eye.
bool is_in_view(const View& view, const Box& box) {
  double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                     corner & 4 ? box.max.z : box.min.z);
    const Vec3 seen = point - view.eye;
    const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
    const double depth = is_perspective ? glm::dot(seen, view.forward) : 1;
    const double place[2] = {glm::dot(seen, view.right) / depth, glm::dot(seen, view.up) / depth};
    for (int axis = 0; axis < 2; ++axis) {
      least[axis] = std::min(least[axis], place[axis]);
      most[axis] = std::max(most[axis], place[axis]);
    }
  }
  const double half_width = view.half_height * view.width_px / view.height_px;
  return least[0] < half_width && most[0] > -half_width && least[1] < view.half_height &&
         most[1] > -view.half_height;
}

/// Returns rays of pixels that show the solid, taken evenly.
std::vector<Ray> sampled_rays(const csgcore::Solid& solid, const View& view) {
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, csgcore::TraceOptions{}, hits, stats);
  std::vector<size_t> seen;
  for (size_t i = 0; i < hits.primitive.size(); ++i) {
    if (hits.primitive[i] != csgcore::Hits::kMiss) seen.push_back(i);
  }
  std::vector<Ray> rays;
  for (size_t i = 0; i < std::min(kRays, seen.size()); ++i) {
    const size_t pixel = seen[i * seen.size() / std::min(kRays, seen.size())];
    rays.push_back(csgcore::pixel_ray(view, static_cast<double>(pixel % view.width_px),
                                      static_cast<double>(pixel / view.width_px)));
  }
  return rays;
}

}  // namespace

CellCounts count_cells(const csgcore::Scene& scene, const View& view, const bench::Rule& rule) {
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  csgcore::SubdivisionOptions options;
  options.leaf_primitives = rule.leaf_primitives;
  if (rule.threshold_px > 0) {
    options = csgcore::SubdivisionOptions::paper(rule.threshold_px, view);
  }
  const csgcore::Subdivision subdivision(solid, options);
  const std::vector<Ray> rays = sampled_rays(solid, view);
  CellCounts counts;
  uint64_t met = 0;
  for (const csgcore::Leaf& leaf : subdivision.leaves()) {
    if (!has_surface(leaf)) continue;
    ++counts.cells;
    if (!is_in_view(view, leaf.box)) continue;
    ++counts.cells_in_view;
    met += static_cast<uint64_t>(std::count_if(
        rays.begin(), rays.end(), [&](const Ray& ray) { return meets(ray, leaf.box); }));
  }
  if (!rays.empty()) {
    counts.cells_per_pixel = static_cast<double>(met) / static_cast<double>(rays.size());
  }
  return counts;
}

}  // namespace measure
