// The test kind of each kind of primitive: what the tests ask of it. A kind's answers are in one
// file, sphere_test_kind.cpp and so on. CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists the kinds;
// one without a test kind does not link. Tests that run over kAllShapes or all_variants(), or that
// draw random primitives, test a new kind at once.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "kinds/local_solid.hpp"
#include "kinds/sizes.hpp"

namespace test_support {

/// Primitives of one kind that share a speciality, such as a point, a box's shape or many faces.
struct Variant {
  const char* name;  // letters only; unique among the variants of all kinds
  /// Makes a primitive in its own frame.
  csgcore::Primitive (*make)(Sizes& sizes);
};

/// A part of a solid's surface, continued beyond the solid: a wall, a cap or a face.
struct Side {
  csgcore::Real outside;  // in local units; negative inside; convex if the kind is
  csgcore::LongVec3 gradient;
};

/// A local solid in OpenSCAD's facets.
struct FacetedSolid {
  csgcore::Mesh mesh;
  std::vector<csgcore::HalfSpace> half_spaces;
};

/// The test kind of a kind. All questions are about a valid primitive of that kind. Points,
/// directions and heights are local, unless a name says otherwise.
class TestKind {
 public:
  /// Returns at least one variant. Each special form that may fail by itself is a variant.
  virtual std::span<const Variant> variants() const = 0;
  /// Returns whether csgcore answers all questions about the kind itself. If it leaves some to the
  /// defaults of PrimitiveKind, the answers must still be right, but need not be tight.
  virtual bool is_told_tightly() const { return true; }

  // By definition, in double:

  virtual bool holds(const csgcore::Primitive& primitive, const csgcore::Vec3& point) const = 0;
  /// Returns a random point of the surface, up to rounding; often on a rim or at a vertex.
  virtual csgcore::Vec3 surface_point(const csgcore::Primitive& primitive,
                                      std::mt19937& random) const = 0;
  /// Returns a point inside the solid, from which the line to the surface point stays inside up to
  /// there.
  virtual csgcore::Vec3 core(const csgcore::Primitive& primitive,
                             const csgcore::Vec3& surface_point) const = 0;

  // In extended precision, for searches:

  /// Returns the point that csgcore takes for the middle; it computes with coordinates relative to
  /// it.
  virtual csgcore::LongVec3 middle(const csgcore::Primitive& primitive) const = 0;
  /// Returns a bound of the points' distances from the middle, in world units.
  virtual csgcore::Real reach_world(const csgcore::Primitive& primitive) const = 0;
  /// Returns the sides at a point, or for a kind that is not convex the distance from the surface.
  /// The solid is where all of them are negative or 0.
  virtual std::vector<Side> sides(const csgcore::Primitive& primitive,
                                  const csgcore::LongVec3& point) const = 0;

  // In extended precision, by formulas, for the reference:

  virtual std::unique_ptr<const csgcore::reference::LocalSolid> solid(
      const csgcore::Primitive& primitive) const = 0;
  /// Returns the maximum over the solid of dot(x, direction).
  virtual double furthest(const csgcore::Primitive& primitive,
                          const csgcore::Vec3& direction) const = 0;

  // For rays that are hard on the solid, which is treated as one about the z axis:

  struct Heights {
    double low, high;
  };
  /// Returns heights between which the z axis is inside the solid.
  virtual Heights heights(const csgcore::Primitive& primitive) const = 0;
  /// Returns the surface point at that height, on that side of the z axis. `sideways` is
  /// horizontal. If its length is not 1, the point is at that share of the way from the axis to the
  /// surface.
  virtual csgcore::Vec3 on_surface(const csgcore::Primitive& primitive,
                                   const csgcore::Vec3& sideways, double height) const = 0;
  /// Returns a direction along the surface at that point, in the plane of the z axis and
  /// `sideways`. By default it is that of the line from the lowest to the highest point on that
  /// side.
  virtual csgcore::Vec3 upwards(const csgcore::Primitive& primitive, const csgcore::Vec3& sideways,
                                const csgcore::Vec3& point) const;
  /// Returns the height at which the wall's lines meet, if they do, inside the solid or beyond it.
  virtual std::optional<double> apex(const csgcore::Primitive& primitive) const;

  // For programs that the renderers are compared with:

  /// Opens the solid in POV-Ray's language. Its texture, its matrix and the closing brace follow.
  virtual std::string as_povray(const csgcore::Primitive& primitive) const = 0;
  /// `fragments` is 3 or more. By default the kind has no facets of its own.
  virtual std::optional<FacetedSolid> faceted(const csgcore::Primitive& primitive,
                                              int fragments) const;

 protected:
  ~TestKind() = default;
};

const TestKind& test_kind_of(csgcore::Shape shape);

#define TEST_SUPPORT_SHAPE(Name) csgcore::Shape::k##Name,
inline constexpr csgcore::Shape kAllShapes[] = {CSGCORE_FOR_EACH_SHAPE(TEST_SUPPORT_SHAPE)};
#undef TEST_SUPPORT_SHAPE

/// Returns the variants of all kinds, kind by kind.
const std::vector<Variant>& all_variants();
/// Returns those of the convex kinds.
const std::vector<Variant>& convex_variants();
/// Prints a variant in the names of tests, which must not contain an address.
void PrintTo(const Variant& variant, std::ostream* out);

/// Returns a primitive of any variant; each kind is equally likely.
csgcore::Primitive random_primitive(Sizes& sizes, const csgcore::Affine& local_to_world);
csgcore::Primitive random_primitive(const TestKind& kind, Sizes& sizes,
                                    const csgcore::Affine& local_to_world);

/// Returns whether the primitive contains the point, by its definition in local space.
bool holds(const csgcore::Primitive& primitive, const csgcore::Vec3& point_world);
/// Returns a random point of the primitive's surface, in world space; often on a rim or at a
/// vertex.
csgcore::Vec3 surface_point(const csgcore::Primitive& primitive, std::mt19937& random);
/// Returns TestKind::core of a point of the surface, both in world space.
csgcore::Vec3 core_of(const csgcore::Primitive& primitive, const csgcore::Vec3& surface_world);

csgcore::Vec3 random_direction(std::mt19937& random);  // has unit length

}  // namespace test_support
