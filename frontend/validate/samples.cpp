#include "samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace validation {

using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;

namespace {

/// Rays and points are sampled in a box that is larger by this share of its diagonal on each side.
constexpr double kMargin = 0.02;

/// The pictures' size shows a design's parts and is no larger, since the oracles take microseconds
/// a pixel.
constexpr uint32_t kWidth_px = 160, kHeight_px = 120;

csgcore::Box grown(csgcore::Box box) {
  const Vec3 margin(kMargin * box.diagonal());
  return {box.min - margin, box.max + margin};
}

void look_along(const Vec3& forward, View& view) {
  view.forward = forward;
  const Vec3 across = std::abs(forward.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  view.right = glm::normalize(glm::cross(forward, across));
  view.up = glm::cross(view.right, forward);
}

/// Returns a log-uniform distance in PointSampler's range.
double random_distance(Random& random, double diagonal) {
  constexpr double kSpan = PointSampler::kFurthest / PointSampler::kNearest;
  return diagonal * PointSampler::kNearest * std::pow(kSpan, random.uniform());
}

bool comes_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

View random_ray_view(const csgcore::Box& box, uint64_t seed, uint64_t index) {
  Random random(seed, Random::Use::kRays, index);
  const csgcore::Box around = grown(box);
  View view;
  view.projection = index % 2 == 0 ? Projection::kOrthographic : Projection::kPerspective;
  view.width_px = view.height_px = 1;
  view.eye = random.point_in(around);
  Vec3 along = random.point_in(around) - view.eye;
  if (glm::length(along) == 0) along = Vec3(0, 0, 1);
  look_along(glm::normalize(along), view);
  // The only pixel's centre is on the axis, so that the pixel's width matters little.
  constexpr double kHalfPixel = 1e-3;
  const bool is_perspective = view.projection == Projection::kPerspective;
  view.half_height = is_perspective ? kHalfPixel : kHalfPixel * box.diagonal();
  return view;
}

View random_view(const csgcore::Box& box, uint64_t seed, uint64_t index) {
  Random random(seed, Random::Use::kViews, index);
  constexpr double kDistance = 2;  // distance of the eye, in diagonals of the box
  View view;
  view.projection = index % 2 == 0 ? Projection::kPerspective : Projection::kOrthographic;
  view.width_px = kWidth_px;
  view.height_px = kHeight_px;
  look_along(random.direction(), view);
  view.eye = box.center() - kDistance * box.diagonal() * view.forward;
  const bool is_perspective = view.projection == Projection::kPerspective;
  // The ball about the box about touches the edges of the picture.
  view.half_height = is_perspective ? 0.5 / kDistance : 0.5 * box.diagonal();
  return view;
}

std::vector<uint32_t> scattered_pixels(const View& view) {
  // Steps of the golden ratio leave gaps of similar sizes (Fibonacci hashing). A step that is
  // coprime with the count visits every pixel.
  const uint64_t count = uint64_t{view.width_px} * view.height_px;
  uint64_t step = static_cast<uint64_t>(0.6180339887498949 * static_cast<double>(count));
  step = std::max<uint64_t>(step, 1);
  while (std::gcd(step, count) != 1) ++step;
  std::vector<uint32_t> pixels;
  for (uint64_t i = 0; i < count; ++i) pixels.push_back(static_cast<uint32_t>(i * step % count));
  return pixels;
}

PointSampler::PointSampler(const csgcore::Box& box, const csgcore::Mesh& boundary, uint64_t seed)
    : box_(box), seed_(seed) {
  for (const std::vector<uint32_t>& face : boundary.faces) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = boundary.vertices[face[i]];
    const auto first = std::min_element(triangle.begin(), triangle.end(), comes_before);
    std::rotate(triangle.begin(), first, triangle.end());
    triangles_.push_back(triangle);
  }
  // CGAL's order depends on addresses, and differs in every run.
  std::sort(triangles_.begin(), triangles_.end(), [](const Triangle& a, const Triangle& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
  });
  double area = 0;
  for (const auto& [a, b, c] : triangles_) {
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    areas_.push_back(area);
  }
}

const PointSampler::Triangle& PointSampler::pick_triangle(Random& random) const {
  const auto at = std::upper_bound(areas_.begin(), areas_.end(), random.uniform() * areas_.back());
  const auto index = std::min<std::ptrdiff_t>(at - areas_.begin(), std::ssize(areas_) - 1);
  return triangles_[static_cast<std::size_t>(index)];
}

Vec3 PointSampler::in_box(uint64_t index) const {
  return Random(seed_, Random::Use::kPointsInBox, index).point_in(grown(box_));
}

Vec3 PointSampler::near_surface(uint64_t index) const {
  if (areas_.empty()) return in_box(index);
  Random random(seed_, Random::Use::kPointsNearSurfaces, index);
  const Triangle& corner = pick_triangle(random);
  // Uniform in the triangle: the unit square is folded along its diagonal.
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0];
  const Vec3 normal = glm::normalize(glm::cross(a, b));
  const double side = random.uniform() < 0.5 ? -1 : 1;
  return corner[0] + u * a + v * b + side * random_distance(random, box_.diagonal()) * normal;
}

Vec3 PointSampler::near_edge(uint64_t index) const {
  if (areas_.empty()) return in_box(index);
  Random random(seed_, Random::Use::kPointsNearEdges, index);
  const Triangle& corner = pick_triangle(random);
  const uint64_t edge = random.next() % 3;
  const Vec3 point = glm::mix(corner[edge], corner[(edge + 1) % 3], random.uniform());
  return point + random_distance(random, box_.diagonal()) * random.direction();
}

}  // namespace validation
