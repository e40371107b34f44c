// Outlines for tests of roofs, and what is measured of these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "plane/roof.hpp"

namespace frontend {

inline Polygon star(const Vec2& center, const std::vector<double>& radii) {
  Polygon result;
  for (size_t i = 0; i < radii.size(); ++i) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
    result.push_back(center + radii[i] * Vec2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

/// Returns a polygon about the origin, of reach 1, with up to three holes. With a `grid`, its
/// coordinates are multiples of that, so that events fall together; then edges may touch.
inline SimplePolygons random_outline(std::mt19937& random, double grid) {
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const auto radii = [&](int count, double least, double most) {
    std::vector<double> result;
    for (int i = 0; i < count; ++i) result.push_back(uniform(least, most));
    return result;
  };
  SimplePolygons result{
      star(Vec2(0.0), radii(std::uniform_int_distribution(8, 30)(random), 0.5, 1))};
  const int holes = std::uniform_int_distribution(0, 3)(random);
  for (int i = 0; i < holes; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3 + uniform(0, 0.3);
    Polygon hole = star(0.2 * Vec2(std::cos(angle), std::sin(angle)),
                        radii(std::uniform_int_distribution(3, 8)(random), 0.05, 0.12));
    std::reverse(hole.begin(), hole.end());
    result.push_back(std::move(hole));
  }
  if (grid > 0) {
    for (Polygon& polygon : result) {
      for (Vec2& point : polygon) point = glm::round(point / grid) * grid;
      polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    }
  }
  return result;
}

inline SimplePolygons turned(SimplePolygons polygons, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) point = Vec2(c * point.x - s * point.y, s * point.x + c * point.y);
  }
  return polygons;
}

/// Returns whether the point lies in the polygons, by the rays' crossings.
inline bool is_within(const Polygons& polygons, const Vec2& point) {
  bool is_inside = false;
  visit_edges(polygons, [&](const Vec2& a, const Vec2& b) {
    if ((a.y > point.y) == (b.y > point.y)) return;
    const double x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x > point.x) is_inside = !is_inside;
  });
  return is_inside;
}

inline double distance_to(const Polygons& polygons, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  visit_edges(polygons, [&](const Vec2& a, const Vec2& b) {
    const double share = glm::dot(point - a, b - a) / glm::dot(b - a, b - a);
    least = std::min(least, glm::length(a + std::clamp(share, 0.0, 1.0) * (b - a) - point));
  });
  return least;
}

/// Calls visit(corners) for each face.
template <typename Visit>
void visit_faces(const Roof& roof, const Visit& visit) {
  uint32_t begin = 0;
  for (const uint32_t end : roof.ends) {
    visit(std::span<const uint32_t>(roof.corners.data() + begin, end - begin));
    begin = end;
  }
}

/// Returns what is twice the area of a face, as a vector perpendicular to it.
inline csgcore::Vec3 area_of_face(const Roof& roof, std::span<const uint32_t> face) {
  csgcore::Vec3 area(0.0);
  const csgcore::Vec3& first = roof.points[face[0]];
  for (size_t i = 1; i + 1 < face.size(); ++i) {
    area += glm::cross(roof.points[face[i]] - first, roof.points[face[i + 1]] - first);
  }
  return area;
}

/// Returns the height of the roof over a point; nan if no face is there.
inline double height_at(const Roof& roof, const Vec2& point) {
  double height = std::numeric_limits<double>::quiet_NaN();
  visit_faces(roof, [&](std::span<const uint32_t> face) {
    Polygon plan;
    for (const uint32_t corner : face) plan.push_back(plan_of(roof.points[corner]));
    if (!is_within({plan}, point)) return;
    const csgcore::Vec3 normal = area_of_face(roof, face);
    const csgcore::Vec3& on = roof.points[face[0]];
    height = on.z + glm::dot(on - csgcore::Vec3(point, on.z), normal) / normal.z;
  });
  return height;
}

/// Returns the volume under the roof.
inline double volume_of(const Roof& roof) {
  double volume = 0;
  visit_faces(roof, [&](std::span<const uint32_t> face) {
    for (size_t i = 1; i + 1 < face.size(); ++i) {
      const csgcore::Vec3 &a = roof.points[face[0]], &b = roof.points[face[i]],
                          &c = roof.points[face[i + 1]];
      volume += glm::cross(b - a, c - a).z / 2 * (a.z + b.z + c.z) / 3;
    }
  });
  return volume;
}

/// Returns whether the faces and the outline are the boundary of a solid: each edge is passed as
/// often in one direction as in the other.
inline bool is_closed(const Roof& roof) {
  std::map<std::pair<uint32_t, uint32_t>, int> passes;
  const auto pass = [&](std::span<const uint32_t> ring, bool is_reversed) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const uint32_t from = ring[i], to = ring[(i + 1) % ring.size()];
      const bool is_up = (from < to) != is_reversed;
      passes[{std::min(from, to), std::max(from, to)}] += is_up ? 1 : -1;
    }
  };
  visit_faces(roof, [&](std::span<const uint32_t> face) { pass(face, false); });
  uint32_t begin = 0;
  for (const uint32_t end : roof.outline_ends) {
    pass({roof.outline.data() + begin, end - begin}, true);
    begin = end;
  }
  return std::ranges::all_of(passes, [](const auto& entry) { return entry.second == 0; });
}

}  // namespace frontend
