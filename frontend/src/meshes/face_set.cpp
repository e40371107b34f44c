#include "meshes/face_set.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "csgcore/stop_scope.hpp"
#include "meshes/triangulation.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using Triangle = csgcore::TriangleMesh::Triangle;

constexpr uint32_t kUnnumbered = 0xFFFFFFFFu;

/// Finds points that are equal, by open addressing.
class PointTable {
 public:
  /// Returns the index of the point among `points`, to which it is added if it is new there.
  uint32_t index_of(const Vec3& point, std::vector<Vec3>& points) {
    if (2 * (points.size() + 1) > slots_.size()) grow(points);
    for (size_t slot = hash(point) & (slots_.size() - 1);;
         slot = (slot + 1) & (slots_.size() - 1)) {
      uint32_t& index = slots_[slot];
      if (index == kUnnumbered) {
        index = static_cast<uint32_t>(points.size());
        points.push_back(point);
      } else if (points[index] != point) {
        continue;
      }
      return index;
    }
  }

 private:
  static uint64_t hash(const Vec3& point) {
    uint64_t result = 0;
    for (int axis = 0; axis < 3; ++axis) {
      // The sum makes −0 a 0.
      result = (result ^ std::bit_cast<uint64_t>(point[axis] + 0.0)) * 0x9E3779B97F4A7C15u;
      result ^= result >> 32;
    }
    return result;
  }

  void grow(const std::vector<Vec3>& points) {
    slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), kUnnumbered);
    for (uint32_t i = 0; i < points.size(); ++i) {
      size_t slot = hash(points[i]) & (slots_.size() - 1);
      while (slots_[slot] != kUnnumbered) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }

  std::vector<uint32_t> slots_;  // indices of points; as many as a power of two
};

bool is_finite_point(const Vec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Gives points new indices in the order in which they are asked for, equal ones the same.
class Renumbering {
 public:
  explicit Renumbering(std::vector<Vec3> points)
      : old_points_(std::move(points)), new_of_(old_points_.size(), kUnnumbered) {}

  bool is_finite(uint32_t index) const { return is_finite_point(old_points_[index]); }
  uint32_t operator()(uint32_t index) {
    uint32_t& known = new_of_[index];
    if (known == kUnnumbered) known = table_.index_of(old_points_[index], points_);
    return known;
  }
  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  std::vector<Vec3> old_points_;
  std::vector<uint32_t> new_of_;
  std::vector<Vec3> points_;
  PointTable table_;
};

Vec3 area_vector(std::span<const Vec3> points, std::span<const uint32_t> ring) {
  const Vec3& apex = points[ring[0]];
  Vec3 sum(0.0);
  for (size_t i = 2; i < ring.size(); ++i) {
    sum += glm::cross(points[ring[i - 1]] - apex, points[ring[i]] - apex);
  }
  return sum;
}

int longest_axis(const Vec3& v) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
  }
  return axis;
}

/// Returns the axis that OpenSCAD looks along: the one nearest to the normal of a triangle in the
/// face. That has the two corners that are furthest apart along the axis where the face is longest,
/// and the corner with which they make the largest triangle.
int axis_of_view(std::span<const Vec3> points, std::span<const uint32_t> face_from_outside) {
  // The first of several corners counts, in the order of a design, where faces run clockwise.
  std::vector<uint32_t> face(face_from_outside.begin(), face_from_outside.end());
  std::reverse(face.begin() + 1, face.end());
  const auto at = [&](uint32_t corner) -> const Vec3& { return points[corner]; };
  std::array<uint32_t, 3> least, most;
  least.fill(face[0]);
  most.fill(face[0]);
  Vec3 size(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const uint32_t corner : face) {
      if (at(corner)[axis] < at(least[axis])[axis]) least[axis] = corner;
      if (at(corner)[axis] > at(most[axis])[axis]) most[axis] = corner;
    }
    size[axis] = at(most[axis])[axis] - at(least[axis])[axis];
  }
  const int along = longest_axis(size);
  const Vec3 base = at(least[along]) - at(most[along]);
  Vec3 normal(0.0);
  for (const uint32_t corner : face) {
    const Vec3 candidate = glm::cross(base, at(corner) - at(most[along]));
    if (glm::dot(candidate, candidate) > glm::dot(normal, normal)) normal = candidate;
  }
  return longest_axis(normal);
}

Vec3 area_vector(std::span<const Vec3> points, std::span<const uint32_t> corners,
                 std::span<const uint32_t> ends) {
  Vec3 sum(0.0);
  uint32_t begin = 0;
  for (const uint32_t end : ends) {
    if (end > begin) sum += area_vector(points, corners.subspan(begin, end - begin));
    begin = end;
  }
  return sum;
}

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

std::span<const uint32_t> FaceSet::face(size_t index) const {
  if (ends.empty()) return {corners.data() + 3 * index, 3};
  const uint32_t begin = index == 0 ? 0 : ends[index - 1];
  return {corners.data() + begin, ends[index] - begin};
}

void project(std::span<const Vec3> points, std::span<const uint32_t> corners,
             std::span<const uint32_t> ends, std::vector<glm::dvec2>& places) {
  const int axis = axis_of_view(points, corners);
  const int right = (axis + 1) % 3, up = (axis + 2) % 3;
  const double sign = area_vector(points, corners, ends)[axis] > 0 ? 1 : -1;
  places.clear();
  for (const uint32_t corner : corners) {
    places.emplace_back(points[corner][right], sign * points[corner][up]);
  }
}

uint64_t tidy(FaceSet& faces) {
  Renumbering renumber(std::move(faces.points));
  uint64_t not_finite = 0;
  uint32_t kept_corners = 0, old_begin = 0;
  size_t kept_faces = 0;
  const size_t count = faces.face_count();
  const bool are_triangles = faces.ends.empty();
  for (size_t i = 0; i < count; ++i) {
    csgcore::stop_point();
    // faces.face(i) would begin where the face before ends by now.
    const uint32_t end = are_triangles ? old_begin + 3 : faces.ends[i];
    const std::span<const uint32_t> face(faces.corners.data() + old_begin, end - old_begin);
    old_begin = end;
    bool has_finite = true;
    for (const uint32_t corner : face) has_finite = has_finite && renumber.is_finite(corner);
    not_finite += !has_finite;
    // A face moves to the front over corners that have been read.
    const uint32_t begin = kept_corners;
    const size_t length = has_finite ? face.size() : 0;
    for (size_t k = 0; k < length; ++k) {
      const uint32_t corner = renumber(face[k]);
      if (kept_corners > begin && faces.corners[kept_corners - 1] == corner) continue;
      faces.corners[kept_corners++] = corner;
    }
    while (kept_corners > begin + 1 && faces.corners[kept_corners - 1] == faces.corners[begin]) {
      --kept_corners;
    }
    if (kept_corners < begin + 3) {
      kept_corners = begin;
      continue;
    }
    if (!faces.colors.empty()) faces.colors[kept_faces] = faces.colors[i];
    if (!are_triangles) faces.ends[kept_faces] = kept_corners;
    ++kept_faces;
  }
  faces.corners.resize(kept_corners);
  if (!are_triangles) faces.ends.resize(kept_faces);
  if (!faces.colors.empty()) faces.colors.resize(kept_faces);
  faces.points = renumber.take_points();
  return not_finite;
}

void weld(FaceSet& faces, double cell) {
  using Edge = std::array<uint32_t, 2>;
  std::vector<std::pair<Edge, int>> edges;  // from the lower point on: 1, and −1 for the other way
  for (size_t i = 0; i < faces.face_count(); ++i) {
    const std::span<const uint32_t> face = faces.face(i);
    for (size_t k = 0; k < face.size(); ++k) {
      const uint32_t from = face[k], to = face[(k + 1) % face.size()];
      edges.push_back({{std::min(from, to), std::max(from, to)}, from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::map<std::array<double, 3>, uint32_t> points;  // of open edges, by their cells
  std::map<uint32_t, uint32_t> joined;               // by point: another one in its place
  const auto join = [&](uint32_t point) {
    if (joined.contains(point)) return;
    std::array<double, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      at[static_cast<size_t>(axis)] = std::trunc(faces.points[point][axis] / cell);
    }
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const auto found = points.find(
          {at[0] + neighbour % 3 - 1, at[1] + neighbour / 3 % 3 - 1, at[2] + neighbour / 9 - 1});
      if (found == points.end()) continue;
      joined[point] = found->second;
      return;
    }
    points[at] = joined[point] = point;
  };
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    csgcore::stop_point();
    int sum = 0;
    for (; end < edges.size() && edges[end].first == edges[begin].first; ++end) {
      sum += edges[end].second;
    }
    if (sum == 0) continue;
    for (const uint32_t point : edges[begin].first) join(point);
  }
  for (uint32_t& corner : faces.corners) {
    const auto other = joined.find(corner);
    if (other != joined.end()) corner = other->second;
  }
}

std::optional<csgcore::Color> take_common_color(FaceSet& faces) {
  const auto& colors = faces.colors;
  if (colors.empty()) return std::nullopt;
  const auto differs = [&](const auto& color) { return color != colors.front(); };
  if (std::any_of(colors.begin(), colors.end(), differs)) return std::nullopt;
  const std::optional<csgcore::Color> color = colors.front();
  faces.colors.clear();
  return color;
}

double enclosed_volume(const FaceSet& faces) {
  double volume = 0;
  for (size_t i = 0; i < faces.face_count(); ++i) {
    const std::span<const uint32_t> face = faces.face(i);
    // From a vertex of the solid, so that no large offset cancels.
    volume +=
        glm::dot(faces.points[face[0]] - faces.points.front(), area_vector(faces.points, face)) / 6;
  }
  return volume;
}

csgcore::Mesh to_mesh(const FaceSet& faces) {
  csgcore::Mesh mesh;
  mesh.vertices = faces.points;
  for (size_t i = 0; i < faces.face_count(); ++i) {
    const std::span<const uint32_t> face = faces.face(i);
    mesh.faces.emplace_back(face.begin(), face.end());
  }
  return mesh;
}

std::vector<Triangle> triangles_of(const FaceSet& faces) {
  std::vector<std::optional<csgcore::Color>> colors;
  return triangles_of(faces, colors);
}

std::vector<Triangle> triangles_of(const FaceSet& faces,
                                   std::vector<std::optional<csgcore::Color>>& colors) {
  colors.clear();
  std::vector<Triangle> triangles;
  triangles.reserve(faces.corners.size() - 2 * faces.face_count());
  std::vector<glm::dvec2> places;
  for (size_t i = 0; i < faces.face_count(); ++i) {
    csgcore::stop_point();
    const std::span<const uint32_t> face = faces.face(i);
    if (face.size() == 3) {
      triangles.push_back({face[0], face[1], face[2]});
    } else {
      const auto end = static_cast<uint32_t>(face.size());
      project(faces.points, face, {&end, 1}, places);
      triangulate(face, places, triangles);
    }
    if (!faces.colors.empty()) colors.resize(triangles.size(), faces.colors[i]);
  }
  return triangles;
}

FaceSet face_set_of(RingedFaces faces) {
  FaceSet result;
  result.points = std::move(faces.points);
  std::vector<uint32_t> corners, ends;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<glm::dvec2> places;
  uint32_t ring = 0;
  for (const uint32_t face_end : faces.face_ends) {
    corners.clear();
    ends.clear();
    for (; ring < face_end; ++ring) {
      const std::span<const uint32_t> of_ring = faces.ring(ring);
      corners.insert(corners.end(), of_ring.begin(), of_ring.end());
      ends.push_back(static_cast<uint32_t>(corners.size()));
    }
    if (ends.size() == 1) {
      result.corners.insert(result.corners.end(), corners.begin(), corners.end());
      result.end_face();
      continue;
    }
    if (corners.empty()) continue;
    triangles.clear();
    project(result.points, corners, ends, places);
    triangulate_all(corners, ends, places, triangles);
    for (const auto& triangle : triangles) {
      result.corners.insert(result.corners.end(), triangle.begin(), triangle.end());
      result.end_face();
    }
  }
  return result;
}

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
