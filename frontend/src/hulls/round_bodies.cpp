#include "hulls/round_bodies.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

namespace frontend {
namespace {

using csgcore::Vec3;

/// The hull of fewer points has all of them as corners, or nearly so.
constexpr size_t kFewBodies = 5;

auto key_of(const RoundBody& body) {
  return std::tuple(-body.radius, body.center.x, body.center.y, body.center.z);
}

PointHull hull_of_centers(const std::vector<RoundBody>& bodies) {
  std::vector<Vec3> centers;
  centers.reserve(bodies.size());
  for (const RoundBody& body : bodies) centers.push_back(body.center);
  return point_hull(on_grid(centers));
}

std::vector<RoundBody> corners_of(const std::vector<RoundBody>& bodies, const PointHull& hull) {
  std::vector<RoundBody> result;
  for (const uint32_t corner : hull.corners) result.push_back(bodies[corner]);
  return result;
}

}  // namespace

RoundBodies without_inner_bodies(std::vector<RoundBody> bodies) {
  RoundBodies result;
  csgcore::Box box;
  for (const RoundBody& body : bodies) {
    box.merge(body.center - body.radius);
    box.merge(body.center + body.radius);
  }
  result.size = box.diagonal();
  std::sort(bodies.begin(), bodies.end(),
            [](const RoundBody& a, const RoundBody& b) { return key_of(a) < key_of(b); });
  for (auto first = bodies.begin(); first != bodies.end();) {
    const auto end = std::find_if(first, bodies.end(), [first](const RoundBody& body) {
      return body.radius != first->radius;
    });
    std::vector<RoundBody> group(first, end);
    const auto is_same = [](const RoundBody& a, const RoundBody& b) {
      return a.center == b.center;
    };
    group.erase(std::unique(group.begin(), group.end(), is_same), group.end());
    if (group.size() >= kFewBodies) {
      PointHull hull = hull_of_centers(group);
      group = corners_of(group, hull);
      const bool is_only = first == bodies.begin() && end == bodies.end();
      if (is_only && hull.dimension == 3) result.hull_of_centers = std::move(hull);
    }
    result.bodies.insert(result.bodies.end(), group.begin(), group.end());
    first = end;
  }
  return result;
}

void add_direction(const Vec3& direction, std::vector<Vec3>& directions) {
  constexpr double kSame = 0x1p-26;
  for (const Vec3& other : directions) {
    const Vec3 gap = direction - other;
    if (glm::dot(gap, gap) <= kSame * kSame) return;
  }
  directions.push_back(direction);
}

}  // namespace frontend
