// What the tests ask of a kind of primitive: its test kind. A kind's answers stand in one file,
// sphere_test_kind.cpp and so on; CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists the kinds, and
// one without a test kind does not link. Tests that run over kAllShapes or all_variants() test a
// new kind at once, and so do those that draw random primitives.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/half_space.hpp"
#include "csgcore/primitive.hpp"
#include "kinds/local_solid.hpp"
#include "kinds/sizes.hpp"

namespace test_support {

/// Primitives of one kind that are special in the same way: pointed, boxes, with many faces.
struct Variant {
  const char* name;  // of letters only; no other variant, of any kind, has it
  /// Makes one in its own frame.
  csgcore::Primitive (*make)(Sizes& sizes);
};

/// A part of a solid's surface, continued beyond the solid: a wall, a cap, a face.
struct Side {
  csgcore::Real outside;  // local units; convex, negative on the inside
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
  /// At least one. Whatever may go wrong with some of the kind's primitives only is a variant.
  virtual std::span<const Variant> variants() const = 0;
  /// Whether csgcore answers all that it can be asked about the kind. If it leaves some to the
  /// defaults of PrimitiveKind, the answers must not be wrong, and need not be tight.
  virtual bool is_told_tightly() const { return true; }

  // By definition, in double:

  virtual bool holds(const csgcore::Primitive& primitive, const csgcore::Vec3& point) const = 0;
  /// A random point of the surface, but for rounding; often of a rim, or a vertex.
  virtual csgcore::Vec3 surface_point(const csgcore::Primitive& primitive,
                                      std::mt19937& random) const = 0;
  /// A point within the solid, from which the line to that point of the surface lies within, and
  /// leaves it there.
  virtual csgcore::Vec3 core(const csgcore::Primitive& primitive,
                             const csgcore::Vec3& surface_point) const = 0;

  // In extended precision, for searches:

  /// What csgcore, which computes with coordinates relative to it, takes for the middle.
  virtual csgcore::LongVec3 middle(const csgcore::Primitive& primitive) const = 0;
  /// No point lies further from the middle, in world units.
  virtual csgcore::Real reach_world(const csgcore::Primitive& primitive) const = 0;
  /// The solid is where all of them are negative or 0.
  virtual std::vector<Side> sides(const csgcore::Primitive& primitive,
                                  const csgcore::LongVec3& point) const = 0;

  // In extended precision, by formulas, for the reference:

  virtual std::unique_ptr<const csgcore::reference::LocalSolid> solid(
      const csgcore::Primitive& primitive) const = 0;
  /// max over the solid of dot(x, direction).
  virtual double furthest(const csgcore::Primitive& primitive,
                          const csgcore::Vec3& direction) const = 0;

  // For rays that are hard on the solid, which is seen as one about the z axis:

  struct Heights {
    double low, high;
  };
  /// Between them the z axis lies within the solid.
  virtual Heights heights(const csgcore::Primitive& primitive) const = 0;
  /// The point of the surface at that height, on that side of the z axis. `sideways` is horizontal;
  /// what its length is, is the share of the way from the axis to the surface.
  virtual csgcore::Vec3 on_surface(const csgcore::Primitive& primitive,
                                   const csgcore::Vec3& sideways, double height) const = 0;
  /// A direction along the surface, in the plane of the z axis and `sideways`, at that point of the
  /// surface. By default the line from the lowest to the highest point on that side.
  virtual csgcore::Vec3 upwards(const csgcore::Primitive& primitive, const csgcore::Vec3& sideways,
                                const csgcore::Vec3& point) const;
  /// The height at which the wall's lines meet, if they do, within the solid or beyond it.
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

/// Those of all kinds, kind by kind.
const std::vector<Variant>& all_variants();
/// For the names of tests, which must not hold an address.
void PrintTo(const Variant& variant, std::ostream* out);

/// Of any variant, each kind being as likely as any other.
csgcore::Primitive random_primitive(Sizes& sizes, const csgcore::Affine& local_to_world);
csgcore::Primitive random_primitive(const TestKind& kind, Sizes& sizes,
                                    const csgcore::Affine& local_to_world);

/// Membership by the definition of the primitive in its local space.
bool holds(const csgcore::Primitive& primitive, const csgcore::Vec3& point_world);
/// A random point of the primitive's surface, in world space; often of a rim, or a vertex.
csgcore::Vec3 surface_point(const csgcore::Primitive& primitive, std::mt19937& random);
/// TestKind::core of a point of the surface, both in world space.
csgcore::Vec3 core_of(const csgcore::Primitive& primitive, const csgcore::Vec3& surface_world);

csgcore::Vec3 random_direction(std::mt19937& random);  // of unit length

}  // namespace test_support
