#include "csgcore/facets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "base/constants.hpp"

namespace csgcore {
namespace {

constexpr double kSqrt1_2 = 0.70710678118654752440;
constexpr double kSqrt3_4 = 0.86602540378443864676;

double radians(double angle_deg) { return angle_deg * (std::numbers::pi / 180); }

// These take angles from 0 to 90°, both included.
double sin_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return 0.5;
  if (angle_deg == 45) return kSqrt1_2;
  if (angle_deg == 60) return kSqrt3_4;
  return angle_deg < 45 ? std::sin(radians(angle_deg)) : std::cos(radians(90 - angle_deg));
}

double cos_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return kSqrt3_4;
  if (angle_deg == 45) return kSqrt1_2;
  if (angle_deg == 60) return 0.5;
  return angle_deg > 45 ? std::sin(radians(90 - angle_deg)) : std::cos(radians(angle_deg));
}

// Sine and cosine of angles in degrees, 0 ≤ angle_deg < 360, as OpenSCAD computes them: exact at
// multiples of 30 and 45, and otherwise the same operations in the same order, so that the bits are
// OpenSCAD's.
double sin_degrees(double angle_deg) {
  if (angle_deg >= 180) return -sin_degrees(angle_deg - 180);
  return sin_first_quadrant(angle_deg > 90 ? 180 - angle_deg : angle_deg);
}

double cos_degrees(double angle_deg) {
  if (angle_deg >= 180) return -cos_degrees(angle_deg - 180);
  return angle_deg > 90 ? -cos_first_quadrant(180 - angle_deg) : cos_first_quadrant(angle_deg);
}

// These are OpenSCAD's: the radius below which it counts no fragments (GRID_FINE), and the least
// value of $fa and $fs.
constexpr double kGridFine = 1.0 / (1 << 20);
constexpr double kLeastFacetSetting = 0.01;
constexpr double kMostFragments = std::numeric_limits<int>::max();

/// Adds a ring of vertices, and returns the index of the first one.
uint32_t add_ring(Mesh& mesh, double radius, double z, int fragments) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int i = 0; i < fragments; ++i) {
    const double angle_deg = 360.0 * i / fragments;
    mesh.vertices.push_back({radius * cos_degrees(angle_deg), radius * sin_degrees(angle_deg), z});
  }
  return first;
}

uint32_t add_vertex(Mesh& mesh, const Vec3& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

void add_cap(Mesh& mesh, uint32_t ring, int fragments, bool upwards) {
  std::vector<uint32_t>& cap = mesh.faces.emplace_back(fragments);
  for (int i = 0; i < fragments; ++i) cap[i] = ring + i;
  if (!upwards) std::reverse(cap.begin(), cap.end());
}

void add_band(Mesh& mesh, uint32_t below, uint32_t above, int fragments) {
  for (int i = 0; i < fragments; ++i) {
    const int next = (i + 1) % fragments;
    mesh.faces.push_back({below + i, below + next, above + next, above + i});
  }
}

/// Adds the triangles between a ring and an apex above or below it.
void add_fan(Mesh& mesh, uint32_t ring, uint32_t apex, int fragments, bool upwards) {
  for (int i = 0; i < fragments; ++i) {
    const int next = (i + 1) % fragments;
    if (upwards) {
      mesh.faces.push_back({ring + i, ring + next, apex});
    } else {
      mesh.faces.push_back({ring + next, ring + i, apex});
    }
  }
}

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

int fragment_count(double radius, const FacetSettings& settings) {
  constexpr double kFewestFragments = 5;  // OpenSCAD's, without $fn
  if (settings.tolerance > 0) {
    // radius · (1 − cos(π/n)) ≤ tolerance, where 1 − cos(x) = 2·sin²(x/2)
    const double sine = std::sqrt(std::min(settings.tolerance / radius / 2, 1.0));
    const double wanted = std::numbers::pi / (2 * std::asin(sine));
    return static_cast<int>(std::ceil(std::clamp(wanted, kFewestFragments, kMostFragments)));
  }
  if (radius < kGridFine || !std::isfinite(settings.fn)) return 3;
  if (settings.fn > 0) {
    return static_cast<int>(std::clamp(settings.fn, 3.0, kMostFragments));
  }
  const double fa = std::max(settings.fa, kLeastFacetSetting);
  const double fs = std::max(settings.fs, kLeastFacetSetting);
  const double wanted = std::min(360 / fa, radius * 2 * std::numbers::pi / fs);
  return static_cast<int>(std::ceil(std::clamp(wanted, kFewestFragments, kMostFragments)));
}

int ring_count(int fragments) { return fragments / 2 + fragments % 2; }

Mesh sphere_mesh(double radius, int fragments) {
  assert(fragments >= 3);
  Mesh mesh;
  const int rings = ring_count(fragments);
  uint32_t above = 0;
  for (int i = 0; i < rings; ++i) {
    const double angle_deg = 180.0 * (i + 0.5) / rings;  // from +Z
    const uint32_t ring =
        add_ring(mesh, radius * sin_degrees(angle_deg), radius * cos_degrees(angle_deg), fragments);
    if (i == 0) {
      add_cap(mesh, ring, fragments, true);
    } else {
      add_band(mesh, ring, above, fragments);
    }
    above = ring;
  }
  add_cap(mesh, above, fragments, false);
  return mesh;
}

Mesh frustum_mesh(double z_min, double z_max, double r_bottom, double r_top, int fragments) {
  assert(fragments >= 3 && z_min < z_max && r_bottom >= 0 && r_top >= 0 && r_bottom + r_top > 0);
  Mesh mesh;
  const uint32_t bottom =
      r_bottom > 0 ? add_ring(mesh, r_bottom, z_min, fragments) : add_vertex(mesh, {0, 0, z_min});
  const uint32_t top =
      r_top > 0 ? add_ring(mesh, r_top, z_max, fragments) : add_vertex(mesh, {0, 0, z_max});
  if (r_bottom > 0) add_cap(mesh, bottom, fragments, false);
  if (r_top > 0) add_cap(mesh, top, fragments, true);
  if (r_bottom == 0) {
    add_fan(mesh, top, bottom, fragments, false);
  } else if (r_top == 0) {
    add_fan(mesh, bottom, top, fragments, true);
  } else {
    add_band(mesh, bottom, top, fragments);
  }
  return mesh;
}

Mesh box_mesh(const Box& box) {
  assert(!box.empty());
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {  // bit 0: x, bit 1: y, bit 2: z
    mesh.vertices.push_back({(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                             (i & 4 ? box.max : box.min).z});
  }
  mesh.faces = {{4, 5, 7, 6}, {2, 3, 1, 0}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return mesh;
}

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
