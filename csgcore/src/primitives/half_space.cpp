#include "csgcore/half_space.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/constants.hpp"
#include "base/degrees.hpp"

namespace csgcore {
namespace {

/// Returns the sectors' vectors. The dot product of a vector with the polygon's vertices at both
/// ends of its sector is 1.
std::vector<glm::dvec2> unit_sectors(int fragments) {
  const double apothem = cos_degrees(180.0 / fragments);
  std::vector<glm::dvec2> sectors;
  for (int j = 0; j < fragments; ++j) {
    const double middle_deg = (360.0 * j + 180) / fragments;
    sectors.push_back({cos_degrees(middle_deg) / apothem, sin_degrees(middle_deg) / apothem});
  }
  return sectors;
}

struct Ring {
  double radius, z;
};

FacetedRevolution::Band band_between(const Ring& a, const Ring& b) {
  const double slope = (a.radius - b.radius) / (a.z - b.z);
  return {a.radius - slope * a.z, slope};
}

using Edge = std::pair<uint32_t, uint32_t>;

/// Returns whether faces run through every edge once in each direction.
bool is_closed(const Mesh& mesh) {
  std::vector<Edge> edges, twins;
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 0; i < face.size(); ++i) {
      edges.emplace_back(face[i], face[(i + 1) % face.size()]);
      twins.emplace_back(edges.back().second, edges.back().first);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  return edges == twins && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

/// Returns whether faces run through every edge twice, in any directions. This is tested first,
/// since it is much faster than finding out which way each face has to run.
bool has_paired_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 0; i < face.size(); ++i) {
      edges.push_back(std::minmax(face[i], face[(i + 1) % face.size()]));
    }
  }
  if (edges.size() % 2 != 0) return false;
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size(); i += 2) {
    const bool is_third = i > 0 && edges[i] == edges[i - 1];
    if (is_third || edges[i] != edges[i + 1]) return false;
  }
  return true;
}

/// Returns the face's normal with twice its area as the length (Newell's method, about the first
/// vertex).
Vec3 area_vector(const Mesh& mesh, const std::vector<uint32_t>& face) {
  const Vec3 first = mesh.vertices[face[0]];
  Vec3 sum(0.0);
  for (size_t i = 2; i < face.size(); ++i) {
    sum += glm::cross(mesh.vertices[face[i - 1]] - first, mesh.vertices[face[i]] - first);
  }
  return sum;
}

}  // namespace

FacetedRevolution faceted_sphere(double radius, int fragments) {
  assert(fragments >= 3);
  const int rings = ring_count(fragments);
  const auto ring = [&](int i) {
    const double angle_deg = 180.0 * (i + 0.5) / rings;
    return Ring{radius * sin_degrees(angle_deg), radius * cos_degrees(angle_deg)};
  };
  FacetedRevolution solid{unit_sectors(fragments), {}, ring(rings - 1).z, ring(0).z};
  for (int i = 0; i + 1 < rings; ++i) solid.bands.push_back(band_between(ring(i), ring(i + 1)));
  return solid;
}

FacetedRevolution faceted_frustum(double z_min, double z_max, double r_bottom, double r_top,
                                  int fragments) {
  assert(fragments >= 3 && z_min < z_max && r_bottom >= 0 && r_top >= 0 && r_bottom + r_top > 0);
  return {unit_sectors(fragments),
          {band_between({r_bottom, z_min}, {r_top, z_max})},
          r_bottom > 0 ? z_min : -kInfinity,
          r_top > 0 ? z_max : kInfinity};
}

std::vector<HalfSpace> half_spaces(const FacetedRevolution& solid) {
  std::vector<HalfSpace> result;
  result.reserve(solid.bands.size() * solid.sectors.size() + 2);
  for (const FacetedRevolution::Band& band : solid.bands) {
    for (const glm::dvec2& sector : solid.sectors) {
      result.push_back({{sector.x, sector.y, -band.slope}, band.radius});
    }
  }
  if (solid.z_min > -kInfinity) result.push_back({{0, 0, -1}, -solid.z_min});
  if (solid.z_max < kInfinity) result.push_back({{0, 0, 1}, solid.z_max});
  return result;
}

std::vector<HalfSpace> half_spaces(const Box& box) {
  assert(!box.empty());
  std::vector<HalfSpace> result;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal(0.0);
    normal[axis] = 1;
    result.push_back({normal, box.max[axis]});
    result.push_back({-normal, -box.min[axis]});
  }
  return result;
}

std::optional<std::vector<HalfSpace>> half_spaces(const Mesh& mesh) {
  if (mesh.faces.empty() || !has_paired_edges(mesh)) return std::nullopt;
  double largest = 0;
  for (const Vec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(v[axis]));
  }
  const double tolerance = kMeshDigits * largest;
  std::vector<HalfSpace> result;
  Mesh outward = mesh;
  for (std::vector<uint32_t>& face : outward.faces) {
    const Vec3 normal = area_vector(mesh, face);
    const double length = glm::length(normal);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    double lowest = kInfinity, highest = -kInfinity;
    for (const Vec3& v : mesh.vertices) {
      lowest = std::min(lowest, glm::dot(normal, v));
      highest = std::max(highest, glm::dot(normal, v));
    }
    double face_lowest = kInfinity, face_highest = -kInfinity;
    for (const uint32_t i : face) {
      face_lowest = std::min(face_lowest, glm::dot(normal, mesh.vertices[i]));
      face_highest = std::max(face_highest, glm::dot(normal, mesh.vertices[i]));
    }
    const double slack = tolerance * length;
    if (highest - lowest <= slack) return std::nullopt;  // the solid is flat
    if (highest - face_lowest <= slack) {
      result.push_back({normal, highest});
    } else if (face_highest - lowest <= slack) {
      result.push_back({-normal, -lowest});
      std::reverse(face.begin(), face.end());
    } else {
      return std::nullopt;
    }
  }
  // The edges of a face that is listed twice are paired, too; is_closed() rejects it.
  if (!is_closed(outward)) return std::nullopt;
  return result;
}

}  // namespace csgcore
