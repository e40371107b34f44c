#include "hulls/round_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include "hulls/point_hull.hpp"
#include "hulls/point_solid.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// The hull of fewer centres is not looked for.
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

/// How far the body reaches from its centre along a direction of unit length.
double reach_along(const Vec3& direction, const RoundBody& body, BodyKind kind) {
  return kind == BodyKind::kBalls ? body.radius
                                  : body.radius * std::hypot(direction.x, direction.y);
}

Vec3 furthest_point(const Vec3& direction, const RoundBody& body, BodyKind kind) {
  if (kind == BodyKind::kBalls) return body.center + body.radius * direction;
  const double across = std::hypot(direction.x, direction.y);
  return body.center + body.radius / across * Vec3(direction.x, direction.y, 0);
}

/// Leaves out bodies that lie within a polyhedron whose corners are points of some of them.
void leave_out_inner(std::vector<RoundBody>& bodies, BodyKind kind, double size) {
  constexpr size_t kManyBodies = 64;  // to compare fewer with each other takes no longer
  constexpr double kRoom = 0x1p-40;   // more than the rounding of the polyhedron's faces
  if (bodies.size() < kManyBodies) return;
  std::vector<Vec3> corners;
  for (const Vec3& direction : spread_directions()) {
    const double of_radius = reach_along(direction, {Vec3(0.0), 1}, kind);
    const RoundBody* furthest = nullptr;
    double most = 0;
    for (const RoundBody& body : bodies) {
      const double reach = glm::dot(direction, body.center) + of_radius * body.radius;
      if (furthest != nullptr && reach <= most) continue;
      furthest = &body;
      most = reach;
    }
    corners.push_back(furthest_point(direction, *furthest, kind));
  }
  const std::vector<csgcore::HalfSpace> faces = faces_of(corners);
  if (faces.empty()) return;
  std::vector<double> of_radius;  // by face
  for (const csgcore::HalfSpace& face : faces) {
    of_radius.push_back(reach_along(face.normal, {Vec3(0.0), 1}, kind));
  }
  std::erase_if(bodies, [&](const RoundBody& body) {
    for (size_t i = 0; i < faces.size(); ++i) {
      const double reach = glm::dot(faces[i].normal, body.center) + of_radius[i] * body.radius;
      if (!(reach < faces[i].offset - kRoom * size)) return false;
    }
    return true;
  });
}

/// Leaves out balls that lie within a larger one. They are in the order of their radii.
void leave_out_contained(std::vector<RoundBody>& balls, double slack) {
  std::vector<RoundBody> kept;
  for (const RoundBody& ball : balls) {
    bool is_contained = false;
    for (size_t i = 0; i < kept.size() && kept[i].radius > ball.radius && !is_contained; ++i) {
      is_contained =
          glm::length(kept[i].center - ball.center) + ball.radius <= kept[i].radius + slack;
    }
    if (!is_contained) kept.push_back(ball);
  }
  balls = std::move(kept);
}

/// Each is a neighbour of all others.
void add_all_neighbors(uint32_t first, uint32_t count, RoundBodies& result) {
  for (uint32_t i = 0; i < count; ++i) {
    std::vector<uint32_t>& own = result.neighbors.emplace_back();
    for (uint32_t k = 0; k < count; ++k) {
      if (k != i) own.push_back(first + k);
    }
  }
}

/// Those before and after each corner of a polygon, or the other end of a line.
void add_neighbors_around(uint32_t first, uint32_t count, RoundBodies& result) {
  for (uint32_t i = 0; i < count; ++i) {
    std::vector<uint32_t>& own = result.neighbors.emplace_back();
    own.push_back(first + (i + 1) % count);
    if (count > 2) own.push_back(first + (i + count - 1) % count);
  }
}

void add_neighbors_in_hull(uint32_t first, const PointHull& hull, RoundBodies& result) {
  std::vector<uint32_t> body(hull.corners.back() + 1);
  for (uint32_t i = 0; i < hull.corners.size(); ++i) body[hull.corners[i]] = first + i;
  result.neighbors.resize(first + hull.corners.size());
  for (const PointHull::Triangle& triangle : hull.triangles) {
    // Each edge is passed once in either direction.
    for (size_t k = 0; k < 3; ++k) {
      result.neighbors[body[triangle[k]]].push_back(body[triangle[(k + 1) % 3]]);
    }
  }
}

void add_class(const std::vector<RoundBody>& group, RoundBodies& result) {
  const auto first = static_cast<uint32_t>(result.bodies.size());
  if (group.size() < kFewBodies) {
    result.bodies.insert(result.bodies.end(), group.begin(), group.end());
    add_all_neighbors(first, static_cast<uint32_t>(group.size()), result);
  } else {
    const PointHull hull = hull_of_centers(group);
    for (const uint32_t corner : hull.corners) result.bodies.push_back(group[corner]);
    if (hull.dimension == 3) {
      add_neighbors_in_hull(first, hull, result);
    } else {
      add_neighbors_around(first, static_cast<uint32_t>(hull.corners.size()), result);
    }
  }
  result.ends.push_back(static_cast<uint32_t>(result.bodies.size()));
}

}  // namespace

const std::vector<Vec3>& spread_directions() {
  static const std::vector<Vec3> directions = [] {
    constexpr int kCount = 128;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3> result;
    for (int i = 0; i < kCount; ++i) {
      const double z = (2 * i + 1.0) / kCount - 1;
      const double across = std::sqrt(1 - z * z);
      result.emplace_back(across * std::cos(golden_angle * i), across * std::sin(golden_angle * i),
                          z);
    }
    return result;
  }();
  return directions;
}

RoundBodies without_inner_bodies(std::vector<RoundBody> bodies, BodyKind kind) {
  RoundBodies result;
  csgcore::Box box;
  for (const RoundBody& body : bodies) {
    box.merge(body.center - body.radius);
    box.merge(body.center + body.radius);
  }
  result.size = box.diagonal();
  std::sort(bodies.begin(), bodies.end(),
            [](const RoundBody& a, const RoundBody& b) { return key_of(a) < key_of(b); });
  const auto is_same = [](const RoundBody& a, const RoundBody& b) {
    return key_of(a) == key_of(b);
  };
  bodies.erase(std::unique(bodies.begin(), bodies.end(), is_same), bodies.end());
  leave_out_inner(bodies, kind, result.size);
  if (kind == BodyKind::kBalls) leave_out_contained(bodies, result.slack());
  for (auto first = bodies.begin(); first != bodies.end();) {
    const auto end = std::find_if(first, bodies.end(), [first](const RoundBody& body) {
      return body.radius != first->radius;
    });
    add_class({first, end}, result);
    first = end;
  }
  return result;
}

void add_direction(const Vec3& direction, std::vector<Vec3>& directions) {
  constexpr double kSameDirection = 0x1p-26;
  for (const Vec3& other : directions) {
    const Vec3 gap = direction - other;
    if (glm::dot(gap, gap) <= kSameDirection * kSameDirection) return;
  }
  directions.push_back(direction);
}

}  // namespace frontend
