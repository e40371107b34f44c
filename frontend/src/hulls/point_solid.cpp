#include "hulls/point_solid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/point_hull.hpp"

namespace frontend {
namespace {

using csgcore::HalfSpace;
using csgcore::Primitive;
using csgcore::Vec3;
using Triangle = PointHull::Triangle;

/// A hull of more faces is a mesh. A sphere of facets takes as long to make and to draw either way
/// from 2,000 facets on.
constexpr size_t kMostFaces = 2000;
/// Corners so near to a triangle's plane count as lying in it, as a share of the hull's size: above
/// the rounding of tangent points, and far below what shows.
constexpr double kSamePlane = 0x1p-46;
/// A hull that is no thicker, as a share of its size, is flat: nothing thinner than 1e-9 of a
/// design is drawn, and the faces of a thinner one meet at angles so small that their rounding
/// moves its edges into sight. At this angle it moves them by 2^-23 of the size.
constexpr double kFlat = 0x1p-30;

/// The hull in coordinates of its own, up to 1.
class LocalHull {
 public:
  LocalHull(const PointGrid& grid, const PointHull& hull) : grid_(grid), hull_(hull) {
    vertex_of_.resize(grid.points.size());
    for (const uint32_t corner : hull.corners) {
      vertex_of_[corner] = static_cast<uint32_t>(vertices_.size());
      const GridPoint& point = grid.points[corner];
      vertices_.emplace_back(local(point.x), local(point.y), local(point.z));
    }
  }

  Primitive solid() const {
    std::vector<HalfSpace> faces = half_spaces();
    if (faces.size() > kMostFaces) return mesh();
    return placed(csgcore::make_polyhedron(
        std::make_shared<csgcore::Polyhedron>(std::move(faces), vertices_)));
  }

  /// In the coordinates of the points.
  std::vector<HalfSpace> placed_half_spaces() const {
    std::vector<HalfSpace> result = half_spaces();
    const double size = std::ldexp(1 / kUnit, grid_.exponent);
    for (HalfSpace& face : result) {
      face.offset = size * face.offset + glm::dot(face.normal, grid_.origin);
    }
    return result;
  }

  /// The polygon as a mesh that is not closed, since it encloses nothing.
  Primitive sheet() const {
    std::vector<csgcore::TriangleMesh::Triangle> triangles;
    for (uint32_t i = 2; i < vertices_.size(); ++i) triangles.push_back({0, i - 1, i});
    return placed(csgcore::make_mesh(
        std::make_shared<csgcore::TriangleMesh>(vertices_, std::move(triangles))));
  }

 private:
  static constexpr double kUnit = 0x1p-52;  // GridPoint reaches up to its inverse
  static double local(int64_t coordinate) { return kUnit * static_cast<double>(coordinate); }

  Primitive placed(Primitive primitive) const {
    const double size = std::ldexp(1 / kUnit, grid_.exponent);
    primitive.local_to_world.linear = csgcore::Mat3(size);
    primitive.local_to_world.translation = grid_.origin;
    return primitive;
  }

  const Vec3& vertex(uint32_t point) const { return vertices_[vertex_of_[point]]; }

  Vec3 normal(const Triangle& t) const {
    return normal_of(grid_.points[t[0]], grid_.points[t[1]], grid_.points[t[2]]);
  }

  /// One for each face. Triangles in the plane of a larger one that they are joined to have none.
  std::vector<HalfSpace> half_spaces() const {
    const size_t count = hull_.triangles.size();
    std::vector<Vec3> normals(count);
    std::vector<double> lengths(count);
    std::vector<uint32_t> order(count);
    for (uint32_t i = 0; i < count; ++i) {
      normals[i] = normal(hull_.triangles[i]);
      lengths[i] = glm::length(normals[i]);
      normals[i] /= lengths[i];
      order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return std::pair(-lengths[a], a) < std::pair(-lengths[b], b);
    });
    std::vector<bool> is_done(count);
    std::vector<HalfSpace> result;
    std::vector<uint32_t> face;
    for (const uint32_t first : order) {
      if (is_done[first]) continue;
      result.push_back(half_space(normals[first], first, is_done, face));
    }
    return result;
  }

  HalfSpace half_space(const Vec3& normal, uint32_t first, std::vector<bool>& is_done,
                       std::vector<uint32_t>& face) const {
    const auto height = [&](uint32_t point) { return glm::dot(normal, vertex(point)); };
    double offset = -std::numeric_limits<double>::infinity();
    const auto reach_over = [&](uint32_t triangle) {
      for (const uint32_t point : hull_.triangles[triangle]) {
        offset = std::max(offset, height(point));
      }
    };
    reach_over(first);
    const double plane = offset;
    const auto is_in_plane = [&](uint32_t triangle) {
      const Triangle& t = hull_.triangles[triangle];
      return std::all_of(t.begin(), t.end(), [&](uint32_t point) {
        return std::abs(height(point) - plane) <= kSamePlane;
      });
    };
    face = {first};
    is_done[first] = true;
    for (size_t next = 0; next < face.size(); ++next) {
      for (const uint32_t neighbor : hull_.neighbors[face[next]]) {
        reach_over(neighbor);
        if (is_done[neighbor] || !is_in_plane(neighbor)) continue;
        is_done[neighbor] = true;
        face.push_back(neighbor);
      }
    }
    return {normal, offset};
  }

  Primitive mesh() const {
    std::vector<csgcore::TriangleMesh::Triangle> triangles;
    triangles.reserve(hull_.triangles.size());
    for (const Triangle& t : hull_.triangles) {
      triangles.push_back({vertex_of_[t[0]], vertex_of_[t[1]], vertex_of_[t[2]]});
    }
    return placed(csgcore::make_mesh(
        std::make_shared<csgcore::TriangleMesh>(vertices_, std::move(triangles))));
  }

  const PointGrid& grid_;
  const PointHull& hull_;
  std::vector<uint32_t> vertex_of_;  // by point
  std::vector<Vec3> vertices_;       // of the corners, in their order
};

/// A point so near to a plane lies on it, as a share of the size.
constexpr double kOnPlane = 0x1p-44;

double size_of(const Corners& corners) {
  csgcore::Box box;
  for (const Vec3& corner : corners) box.merge(corner);
  return box.diagonal();
}

Corners without_inner_points(const Corners& points) {
  const PointHull hull = point_hull(on_grid(points));
  Corners result;
  if (hull.dimension < 3) return result;
  for (const uint32_t corner : hull.corners) result.push_back(points[corner]);
  return result;
}

}  // namespace

std::vector<HalfSpace> faces_of(std::span<const Vec3> corners) {
  const PointGrid grid = on_grid(corners);
  const PointHull hull = point_hull(grid, kFlat);
  if (hull.dimension < 3) return {};
  return LocalHull(grid, hull).placed_half_spaces();
}

std::optional<PointSolid> solid_of_points(std::span<const Vec3> points) {
  const PointGrid grid = on_grid(points);
  const PointHull hull = point_hull(grid, kFlat);
  if (hull.dimension < 2) return std::nullopt;
  const LocalHull local(grid, hull);
  if (hull.dimension == 2) return PointSolid{local.sheet(), true};
  return PointSolid{local.solid(), false};
}

Corners cut(const Corners& corners, const HalfSpace& half_space) {
  const double slack = kOnPlane * size_of(corners) * glm::length(half_space.normal);
  std::vector<double> heights;
  bool has_inner = false;
  bool has_outer = false;
  for (const Vec3& corner : corners) {
    heights.push_back(glm::dot(half_space.normal, corner) - half_space.offset);
    has_inner = has_inner || heights.back() < -slack;
    has_outer = has_outer || heights.back() > slack;
  }
  if (!has_inner) return {};
  if (!has_outer) return corners;
  Corners result;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (heights[i] <= slack) result.push_back(corners[i]);
  }
  for (const PointHull::Triangle& triangle : point_hull(on_grid(corners)).triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t inner = triangle[k], outer = triangle[(k + 1) % 3];
      // Each edge is passed once in either direction.
      if (!(heights[inner] < -slack && heights[outer] > slack)) continue;
      const double share = heights[inner] / (heights[inner] - heights[outer]);
      result.push_back(corners[inner] + share * (corners[outer] - corners[inner]));
    }
  }
  return without_inner_points(result);
}

Corners intersection(const Corners& corners, std::span<const HalfSpace> half_spaces) {
  Corners result = corners;
  for (const HalfSpace& half_space : half_spaces) {
    if (result.empty()) break;
    result = cut(result, half_space);
  }
  return result;
}

std::vector<Corners> difference(const Corners& corners, std::span<const HalfSpace> half_spaces) {
  if (intersection(corners, half_spaces).empty()) return {corners};
  std::vector<Corners> result;
  Corners rest = corners;
  for (const HalfSpace& half_space : half_spaces) {
    Corners outside = cut(rest, {-half_space.normal, -half_space.offset});
    if (!outside.empty()) result.push_back(std::move(outside));
    rest = cut(rest, half_space);
  }
  return result;
}

}  // namespace frontend
