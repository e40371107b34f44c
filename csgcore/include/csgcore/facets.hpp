// The facets that OpenSCAD gives its primitives (frontend/OPENSCAD.md, "Facets"), vertex by
// vertex, in the primitive's own frame.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace csgcore {

/// $fn, $fa (degrees) and $fs of a round primitive, with OpenSCAD's default values.
struct FacetSettings {
  double fn = 0;
  double fa = 12;
  double fs = 2;
};

/// Returns how many fragments OpenSCAD gives a circle of that radius, at least 3. Counts above 2^31
/// − 1 are clamped to it.
int fragment_count(double radius, const FacetSettings& settings);

/// Returns how many rings of vertices a faceted sphere has.
int ring_count(int fragments);

/// The boundary of a polyhedron. A face lists the indices of its vertices, at least three,
/// counterclockwise as seen from outside.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::vector<uint32_t>> faces;
};

/// The mesh of OpenSCAD's sphere. The vertices are the doubles that OpenSCAD computes, bit for bit.
/// The quadrilaterals between two rings are single faces, which OpenSCAD cuts into triangles.
/// `fragments` ≥ 3; the sphere has about fragments²/2 vertices. The primitive must be valid
/// (is_valid).
Mesh sphere_mesh(double radius, int fragments);
/// The mesh of OpenSCAD's cylinder, likewise. A radius of 0 makes an apex. The vertices of the
/// bottom come first.
Mesh frustum_mesh(double z_min, double z_max, double r_bottom, double r_top, int fragments);
/// The mesh of OpenSCAD's cube. The box must not be empty.
Mesh box_mesh(const Box& box);

struct Primitive;
/// The mesh of a primitive's local solid with that many fragments around, 3 or more: OpenSCAD's, as
/// above, where it has the solid. Its faces are convex. It is empty where the solid is not round,
/// or made of a profile.
Mesh faceted_mesh(const Primitive& primitive, int fragments);

}  // namespace csgcore
