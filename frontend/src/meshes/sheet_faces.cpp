#include "meshes/sheet_faces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace frontend {
namespace {

using csgcore::Vec3;
using Triangle = csgcore::TriangleMesh::Triangle;

/// A share of a body's size: points that are no further from a plane lie in it. The rounding of
/// turned points is some 2^-50, and a solid is thicker than the thinnest piece that is drawn,
/// 1e-9 of the size.
constexpr double kRoundingOfSize = 0x1p-40;

Vec3 area_of(std::span<const Vec3> points, const Triangle& t) {
  return glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Returns those of which each other triangle is the reverse; empty if one has no reverse.
std::vector<Triangle> one_of_each_pair(std::span<const Triangle> triangles) {
  std::map<Triangle, int> sums;  // by sorted corners
  std::vector<Triangle> result;
  for (const Triangle& triangle : triangles) {
    Triangle corners = triangle;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const bool is_turned = corners[1] > corners[2];
    if (is_turned) std::swap(corners[1], corners[2]);
    const auto [entry, is_new] = sums.try_emplace(corners, 0);
    entry->second += is_turned ? -1 : 1;
    if (is_new) result.push_back(triangle);
  }
  const bool is_paired =
      std::all_of(sums.begin(), sums.end(), [](const auto& entry) { return entry.second == 0; });
  return is_paired ? result : std::vector<Triangle>();
}

}  // namespace

std::vector<Triangle> sheet_of(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  if (triangles.empty()) return {};
  csgcore::Box box;
  for (const Vec3& point : points) box.merge(point);
  const double size = glm::length(box.size());
  double volume = 0, largest_area = 0;
  Vec3 normal(0.0);
  for (const Triangle& t : triangles) {
    const Vec3 area = area_of(points, t);
    volume += glm::dot(points[t[0]] - box.min, area);
    const double length = glm::length(area);
    if (length > largest_area) normal = area / (largest_area = length);
  }
  if (!(std::abs(volume) <= kRoundingOfSize * size * size * size)) return {};
  const double height = glm::dot(points[triangles.front()[0]], normal);
  const bool is_plane = std::all_of(points.begin(), points.end(), [&](const Vec3& point) {
    return std::abs(glm::dot(point, normal) - height) <= kRoundingOfSize * size;
  });
  if (!is_plane) return one_of_each_pair(triangles);
  std::vector<Triangle> result;
  for (const Triangle& t : triangles) {
    if (glm::dot(area_of(points, t), normal) > 0) result.push_back(t);
  }
  return result;
}

}  // namespace frontend
