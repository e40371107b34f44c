// The traits of each kind of primitive: what the frontend and `scadray validate` ask of it. A
// kind's answers are in one file, sphere_traits.cpp and so on, which primitive_traits.cpp lists; a
// kind without one has the defaults.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "frontend/facet_mesh.hpp"

namespace frontend {

/// Healing compares the plane faces of solids. A solid with more than so many is taken for curved:
/// none of its faces is compared.
constexpr uint32_t kMostComparedFaces = 32;

/// A face in local coordinates.
struct PlaneFace {
  csgcore::Vec3 center;  // a point of the plane amid the corners
  csgcore::Vec3 normal;  // unit; it may point outwards or inwards
  /// The face that is parallel to this one, in every affine image.
  std::optional<uint32_t> opposite;
  /// The face's corners among those of all faces: three or more points that span it. An apex has
  /// none. It is compared with nothing, but may be the opposite of a face.
  uint32_t first_corner = 0, corner_count = 0;
};

/// A solid's faces, numbered from 0; at most kMostComparedFaces.
struct PlaneFaces {
  std::vector<PlaneFace> faces;
  std::vector<csgcore::Vec3> corners;

  std::span<const csgcore::Vec3> corners_of(const PlaneFace& face) const {
    return std::span(corners).subspan(face.first_corner, face.corner_count);
  }
  void clear() {
    faces.clear();
    corners.clear();
  }
};

/// Two unit vectors are parallel if their cross product is no longer than this. It is far above the
/// rounding of doubles and far below that of six digits. A vector this near to a plane stays in it
/// under the moves of healing, which are of the order of 1e-6.
constexpr double kParallel = 1e-9;
bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b);

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

/// Designs from 2^-300 to 2^300 across (1e-90 to 1e90) are drawn. The determinant of their
/// matrices, a product of three factors, stays well within the range of doubles.
constexpr int kLargestExponent = 300;

/// Returns a bound of the primitive's extents, from its local size and its matrix without the
/// translation. It is inf beyond the range of doubles, and 0 if all extents vanish. Preconditions:
/// the shape is valid (csgcore::has_valid_shape), and the matrix finite.
double size_of(const csgcore::Primitive& primitive);

/// Returns the box of the regular polygon with `fragments` (≥ 3) vertices on the unit circle, the
/// first at (1, 0), as OpenSCAD's circle has them; its z is 0. A call with the same number as the
/// thread's last one computes nothing. The reference is valid until the thread's next call.
const csgcore::Box& unit_polygon_box(int fragments);

}  // namespace frontend
