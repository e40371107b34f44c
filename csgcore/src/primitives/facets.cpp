#include "csgcore/facets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/degrees.hpp"

namespace csgcore {
namespace {

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

}  // namespace

int fragment_count(double radius, const FacetSettings& settings) {
  if (radius < kGridFine || !std::isfinite(settings.fn)) return 3;
  if (settings.fn > 0) {
    return static_cast<int>(std::clamp(settings.fn, 3.0, kMostFragments));
  }
  const double fa = std::max(settings.fa, kLeastFacetSetting);
  const double fs = std::max(settings.fs, kLeastFacetSetting);
  const double wanted = std::min(360 / fa, radius * 2 * std::numbers::pi / fs);
  return static_cast<int>(std::ceil(std::clamp(wanted, 5.0, kMostFragments)));
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

}  // namespace csgcore
