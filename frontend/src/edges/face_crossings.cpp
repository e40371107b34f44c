#include "edges/face_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

namespace frontend {
namespace {

using csgcore::Vec3;

/// The sine of the angle below which two planes are parallel.
constexpr double kParallel = 1e-7;

/// Finds the two points in which the boundary of a convex face crosses a plane. Returns false if
/// there are not two, or if they are the ends of an edge of the face.
bool cross_plane(std::span<const Vec3> corners, const BodyPlane& plane, double tolerance,
                 std::array<Vec3, 2>& points) {
  const size_t count = corners.size();
  size_t found = 0;
  std::array<size_t, 2> at{};  // twice the corner's index, and one more within the edge behind it
  const auto add = [&](const Vec3& point, size_t place) {
    if (found < 2) {
      points[found] = point;
      at[found] = place;
    }
    ++found;
  };
  const auto height = [&](size_t i) {
    const double above = plane.above(corners[i]);
    return std::abs(above) <= tolerance ? 0 : above;
  };
  double a = height(0);
  for (size_t i = 0; i < count; ++i) {
    const size_t next = i + 1 < count ? i + 1 : 0;
    const double b = height(next);
    if (a == 0) {
      add(corners[i], 2 * i);
    } else if (a * b < 0) {
      add(corners[i] + a / (a - b) * (corners[next] - corners[i]), 2 * i + 1);
    }
    a = b;
  }
  if (found != 2) return false;
  const size_t apart = at[1] - at[0];
  const bool are_neighbours =
      at[0] % 2 == 0 && at[1] % 2 == 0 && (apart == 2 || apart == 2 * count - 2);
  return !are_neighbours;
}

}  // namespace

void cross_faces(const Body& a, const Body& b, uint64_t& steps,
                 const std::function<bool(const Vec3&, const Vec3&)>& visit) {
  const double tolerance = std::max(a.tolerance, b.tolerance);
  std::vector<Vec3> corners_a, corners_b;
  std::vector<uint32_t> near_b, near_a;
  a.faces.for_each_near(b.box, tolerance, steps, [&](uint32_t face) { near_b.push_back(face); });
  for (const uint32_t face_a : near_b) {
    const BodyPlane& plane_a = a.planes[face_a];
    a.face(face_a, corners_a);
    near_a.clear();
    b.faces.for_each_near(a.faces.box_of(face_a), tolerance, steps,
                          [&](uint32_t face) { near_a.push_back(face); });
    for (const uint32_t face_b : near_a) {
      const BodyPlane& plane_b = b.planes[face_b];
      const Vec3 across = glm::cross(plane_a.normal, plane_b.normal);
      const double sine = glm::length(across);
      if (sine < kParallel) continue;
      std::array<Vec3, 2> in_a, in_b;
      if (!cross_plane(corners_a, plane_b, tolerance, in_a)) continue;
      b.face(face_b, corners_b);
      if (!cross_plane(corners_b, plane_a, tolerance, in_b)) continue;
      // Both segments lie in the line in which the planes meet.
      const Vec3 direction = across / sine;
      const auto place = [&](const Vec3& point) { return glm::dot(direction, point - in_a[0]); };
      const auto [begin_a, end_a] = std::minmax({0.0, place(in_a[1])});
      const auto [begin_b, end_b] = std::minmax({place(in_b[0]), place(in_b[1])});
      const double begin = std::max(begin_a, begin_b);
      const double end = std::min(end_a, end_b);
      if (end - begin <= tolerance) continue;
      if (!visit(in_a[0] + begin * direction, in_a[0] + end * direction)) return;
    }
  }
}

}  // namespace frontend
