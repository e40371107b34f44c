// The facets that OpenSCAD gives its primitives (frontend/OPENSCAD.md, "Facets"), in the
// primitive's own frame: vertex by vertex, and as half-spaces.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"

namespace csgcore {

/// $fn, $fa (degrees) and $fs of a round primitive, with OpenSCAD's default values.
struct FacetSettings {
  double fn = 0;
  double fa = 12;
  double fs = 2;
  /// In place of the others unless it is 0: the largest distance of a circle from its chords.
  double tolerance = 0;
};

/// Returns how many fragments a circle of that radius has by the settings, at least 3. Counts above
/// 2^31 − 1 are clamped to it.
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

// Convex polyhedra as intersections of half-spaces whose doubles are taken as exact.
//
// OpenSCAD lists the vertices of a polyhedron, and rounds them, so that the four corners of a facet
// lie in no plane. Half-spaces have no such trouble: every set of them defines one convex solid,
// whose facets are plane and whose vertices are rationals. So csgcore and its oracles take the
// half-spaces for the definition of a polyhedron.

/// The points x with normal·x ≤ offset. The normal points outwards and may have any length but 0.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// A faceted solid of revolution about z:
///
///   max_j sectors_j·(x, y) ≤ min_k (bands_k.radius + bands_k.slope·z),   z_min ≤ z ≤ z_max.
///
/// The left side measures (x, y) by the polygon that is inscribed in the unit circle, and is the
/// same for all z. So the facets of two sectors and two bands meet in one point, however they are
/// rounded, and all facets are trapezoids. The facet of a direction or a height is found without a
/// search.
struct FacetedRevolution {
  struct Band {
    double radius;  // of the circle through the vertices, extrapolated to z = 0
    double slope;   // growth of the radius with z
  };
  std::vector<glm::dvec2>
      sectors;              // sector j lies between the vertices at 360·j/n and 360·(j+1)/n°
  std::vector<Band> bands;  // from the top down, slopes increasing
  double z_min, z_max;      // −inf, +inf: no cap, since the bands end in an apex
};

/// The facets of sphere_mesh() and frustum_mesh(), with the same preconditions. Their
/// vertices differ from the mesh's by the rounding of the planes only, which along a band of a
/// sphere is amplified by up to `fragments`.
FacetedRevolution faceted_sphere(double radius, int fragments);
FacetedRevolution faceted_frustum(double z_min, double z_max, double r_bottom, double r_top,
                                  int fragments);

/// Returns the half-spaces band by band from the top down, sector by sector within a band; then
/// those of the lower and the upper cap, if there.
std::vector<HalfSpace> half_spaces(const FacetedRevolution& solid);
/// Returns the six half-spaces of a box, which must not be empty.
std::vector<HalfSpace> half_spaces(const Box& box);

/// Returns one half-space for each face of the mesh, as far out as its outermost vertex, so that no
/// vertex is cut off. A face may list its vertices in either direction, whatever other faces do.
/// Returns nothing unless the mesh is, within kMeshDigits of its largest coordinate, the closed
/// boundary of one convex solid with plane faces.
std::optional<std::vector<HalfSpace>> half_spaces(const Mesh& mesh);

/// A .csg holds 6 significant digits, so that a coordinate is off by up to 5e-6 of itself. A vertex
/// and the plane that it is compared with are both off by so much.
constexpr double kMeshDigits = 1e-5;

}  // namespace csgcore
