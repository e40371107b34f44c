// What the frontend and `scadray validate` ask of a kind of primitive: its traits. A kind's answers
// stand in one file, sphere_traits.cpp and so on; CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists
// the kinds, and one without traits does not link.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

struct PlaneFaces;

/// OpenSCAD's facets of a primitive are those of `unit`, stretched along the local axes and moved:
/// x ↦ origin + size · x, by coordinate. Primitives with the same `unit` share their facets.
struct Faceting {
  csgcore::Primitive unit;  // under the identity
  csgcore::Vec3 origin{0.0}, size{1.0};
  uint64_t faces = 0;  // no fewer than there will be
};

/// About what a local solid is round, and how large around: what healing compares with that of
/// other primitives. Two that share an axis, or a centre, may share a radius.
struct Roundness {
  enum class About : uint8_t { kNothing, kAxis /* local z */, kCenter /* the local origin */ };
  About about = About::kNothing;
  std::array<double, 2> radii{};   // 0: there is none
  std::array<double, 2> axis_z{};  // of kAxis: the local z of two different points on it
};

/// Where a local point lies against the smooth surface that facets cut short.
struct RadialPlace {
  csgcore::Vec3 part{0.0};     // of the point, as a vector: all of it, or what is across the axis
  double surface = 0;          // the length of `part` at which the smooth surface is
  double largest_surface = 0;  // the largest that `surface` can be within the solid
  double height = 0;           // from one end to the other, where it has ends: 0 to 1 within
};

/// The traits of a kind. All questions are about a primitive of that kind whose shape is valid
/// (csgcore::has_valid_shape), whatever its matrix is, and the answers are in local space.
class PrimitiveTraits {
 public:
  /// No coordinate of the solid is larger. It may exceed the largest one by a small factor.
  virtual double extent(const csgcore::Primitive& primitive) const;

  /// The fragments that OpenSCAD gives it around; 0: OpenSCAD draws it alike whatever the settings
  /// are.
  virtual int fragments(const csgcore::Primitive& primitive,
                        const csgcore::FacetSettings& settings) const;
  /// The box of the solid that OpenSCAD draws, in facets.
  virtual csgcore::Box faceted_box(const csgcore::Primitive& primitive,
                                   const csgcore::FacetSettings& settings) const;
  /// What primitives with the same facets have in common. `fragments` is 3 or more, here and below.
  virtual Faceting faceting(const csgcore::Primitive& primitive, int fragments) const;
  /// The convex polyhedron that OpenSCAD makes of the solid; of a polyhedron, itself. Null: there
  /// is none, and `scadray validate` does not compare the design with CGAL.
  virtual std::shared_ptr<const csgcore::Polyhedron> faceted(const csgcore::Primitive& primitive,
                                                             int fragments) const;

  virtual Roundness roundness(const csgcore::Primitive& primitive) const;
  /// Writes the solid's plane faces into an empty list; none if there are more than
  /// kMostComparedFaces.
  virtual void find_plane_faces(const csgcore::Primitive& primitive, PlaneFaces& faces) const;

  /// The facets are nowhere further below the smooth surface than at this share of its radius.
  virtual double inscribed_share(int fragments) const;
  /// Nothing if faceted() is the solid itself.
  virtual std::optional<RadialPlace> radial_place(const csgcore::Primitive& primitive,
                                                  const csgcore::Vec3& point) const;

 protected:
  ~PrimitiveTraits() = default;
};

const PrimitiveTraits& traits_of(csgcore::Shape shape);

/// All that makes a local solid: primitives of which these are equal have the same one. A parameter
/// that Primitive gains has to be added.
using LocalSolid =
    std::tuple<csgcore::Shape, double, double, double, double, const csgcore::Polyhedron*>;
LocalSolid local_solid(const csgcore::Primitive& primitive);

}  // namespace frontend
