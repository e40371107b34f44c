// The traits of each kind of primitive: what the frontend and `scadray validate` ask of it. A
// kind's answers are in one file, sphere_traits.cpp and so on, which primitive_traits.cpp lists; a
// kind without one has the defaults.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "frontend/facet_mesh.hpp"

namespace frontend {

struct PlaneFaces;

/// OpenSCAD's facets of a primitive are those of `unit`, stretched along the local axes and moved:
/// x ↦ origin + size · x, by coordinate. Primitives with the same `unit` share their facets.
struct Faceting {
  csgcore::Primitive unit;  // its matrix is the identity
  csgcore::Vec3 origin{0.0}, size{1.0};
  uint64_t faces = 0;  // an upper bound
};

/// The axis or centre about which a local solid is round, and its radii there. Healing compares
/// them with those of other primitives: two that share an axis or a centre may share a radius.
struct Roundness {
  enum class About : uint8_t { kNothing, kAxis /* local z */, kCenter /* the local origin */ };
  About about = About::kNothing;
  std::array<double, 2> radii{};   // 0: there is none
  std::array<double, 2> axis_z{};  // of kAxis: the local z of two different points on the axis
};

/// The place of a local point relative to the smooth surface, which facets cut short.
struct RadialPlace {
  csgcore::Vec3 part{0.0};     // the point as a vector, or its component across the axis
  double surface = 0;          // the length of `part` on the smooth surface
  double largest_surface = 0;  // the largest `surface` within the solid
  double height = 0;           // of a solid with ends: 0 to 1 from one to the other
};

/// The traits of a kind. Each function takes a primitive of that kind with a valid shape
/// (csgcore::has_valid_shape) and any matrix, and answers in local space.
class PrimitiveTraits {
 public:
  /// Returns a bound of the solid's coordinates, which may exceed the largest one by a small
  /// factor.
  virtual double extent(const csgcore::Primitive& primitive) const;

  /// Returns the fragments that OpenSCAD gives the primitive around; 0: the settings have no
  /// effect.
  virtual int fragments(const csgcore::Primitive& primitive,
                        const csgcore::FacetSettings& settings) const;
  /// Returns the box of the faceted solid that OpenSCAD draws.
  virtual csgcore::Box faceted_box(const csgcore::Primitive& primitive,
                                   const csgcore::FacetSettings& settings) const;
  /// Returns the part of the faceting that may be shared. `fragments` is 3 or more, here and below.
  virtual Faceting faceting(const csgcore::Primitive& primitive, int fragments) const;
  /// Returns the faces of csgcore::faceted_polyhedron() as OpenSCAD makes them. None for a kind
  /// that is not round.
  virtual RevolvedFaces revolved_faces(const csgcore::Primitive& primitive, int fragments) const;

  virtual Roundness roundness(const csgcore::Primitive& primitive) const;
  /// Writes the solid's plane faces into `faces`, which is empty before. Writes none if there are
  /// more than kMostComparedFaces.
  virtual void find_plane_faces(const csgcore::Primitive& primitive, PlaneFaces& faces) const;

  /// Returns a share of the radius: the facets are nowhere further below the smooth surface.
  virtual double inscribed_share(int fragments) const;
  /// Returns where the point is; nothing if csgcore::faceted_polyhedron() is the solid itself.
  virtual std::optional<RadialPlace> radial_place(const csgcore::Primitive& primitive,
                                                  const csgcore::Vec3& point) const;
};

const PrimitiveTraits& traits_of(csgcore::Shape shape);

}  // namespace frontend
