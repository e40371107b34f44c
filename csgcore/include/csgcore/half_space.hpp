// Convex polyhedra as intersections of half-spaces whose doubles are taken as exact.
//
// A polyhedron of OpenSCAD is a list of vertices that are rounded, so that the four corners of a
// facet lie in no plane. Half-spaces have no such trouble: any of them define one convex solid,
// whose facets are plane and whose vertices are rationals. They are what csgcore and its oracles
// agree on.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"

namespace csgcore {

/// normal·x ≤ offset. The normal points outwards and need not be of unit length.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// A faceted solid of revolution about z:
///
///   max_j sectors_j·(x, y) ≤ min_k (bands_k.radius + bands_k.slope·z),   z_min ≤ z ≤ z_max.
///
/// The left side measures (x, y) by the polygon that is inscribed in the unit circle: it is the
/// same for all z. So the facets of two sectors and two bands meet in one point, however they are
/// rounded, and all are trapezoids. Which facet a direction or a height belongs to is known without
/// a search.
struct FacetedRevolution {
  struct Band {
    double radius;  // of the circle through the vertices, where the band's plane meets z = 0
    double slope;   // its growth with z
  };
  std::vector<glm::dvec2>
      sectors;              // sector j lies between the vertices at 360·j/n and 360·(j+1)/n°
  std::vector<Band> bands;  // from the top down, slopes increasing
  double z_min, z_max;      // −inf, +inf: no cap, since the bands end in an apex
};

/// The primitives of facets.hpp, with the same preconditions. The vertices are those of the mesh
/// but for rounding: of the planes, and along a band of a sphere amplified by up to `fragments`.
FacetedRevolution faceted_sphere(double radius, int fragments);
FacetedRevolution faceted_frustum(double z_min, double z_max, double r_bottom, double r_top,
                                  int fragments);

/// bands × sectors, from the top down, sector by sector; then the cap below and the cap above, if
/// there.
std::vector<HalfSpace> half_spaces(const FacetedRevolution& solid);
/// Of a box that is not empty.
std::vector<HalfSpace> half_spaces(const Box& box);

/// One half-space a face, as far out as the outermost vertex: none is cut off. The faces may run
/// either way, each for itself: the solid lies on one side of its plane. Nothing if the mesh is not
/// the closed boundary of one convex solid with plane faces, within kMeshDigits of its largest
/// coordinate.
std::optional<std::vector<HalfSpace>> half_spaces(const Mesh& mesh);

/// A .csg holds 6 significant digits: a coordinate is off by up to 5e-6 of itself, a vertex and the
/// plane that it is compared with by twice that.
constexpr double kMeshDigits = 1e-5;

}  // namespace csgcore
