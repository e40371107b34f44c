// The facets that OpenSCAD gives its primitives (frontend/OPENSCAD.md, "Facets"), vertex by
// vertex, in the primitive's own frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"

namespace csgcore {

/// $fn, $fa (degrees) and $fs of a round primitive, with OpenSCAD's defaults.
struct FacetSettings {
  double fn = 0;
  double fa = 12;
  double fs = 2;
};

/// The fragments that OpenSCAD gives a circle of that radius, from 3 up. Very large counts are cut
/// at 2^31 − 1.
int fragment_count(double radius, const FacetSettings& settings);

/// The rings of vertices that a faceted sphere has.
int ring_count(int fragments);

/// The boundary of a polyhedron. A face is the indices of its vertices, three or more,
/// counterclockwise seen from outside.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::vector<uint32_t>> faces;
};

/// The vertices are the doubles that OpenSCAD computes, bit for bit; a face that OpenSCAD cuts into
/// coplanar triangles (between two rings of different radii) is one. `fragments` ≥ 3; the sphere
/// has about fragments²/2 vertices. The primitive must be valid (is_valid).
Mesh sphere_mesh(double radius, int fragments);
/// A radius of 0 makes an apex. Vertices: the bottom's, then the top's.
Mesh frustum_mesh(double z_min, double z_max, double r_bottom, double r_top, int fragments);
/// OpenSCAD's cube. The box must not be empty.
Mesh box_mesh(const Box& box);
/// OpenSCAD's polyhedron, whose faces run clockwise seen from outside. As there, an index beyond
/// the points is left out; faces of fewer than three different points in a row are too, and points
/// that are equal become one.
Mesh polyhedron_mesh(std::span<const Vec3> points, std::span<const std::vector<uint32_t>> faces);

}  // namespace csgcore
