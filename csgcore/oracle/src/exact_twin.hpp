// What the oracles ask of a kind of primitive: its exact twin. A kind's answers stand in one file,
// sphere_twin.cpp and so on; CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists the kinds, and one
// without a twin does not link.
#pragma once

#include <string>
#include <vector>

#include "csgcore/primitive.hpp"
#include "exact_primitive.hpp"

namespace csgcore {
struct HalfSpace;
}

namespace oracle {

/// The exact twin of a kind. All questions are about a valid primitive of that kind.
class ExactTwin {
 public:
  /// A point well within the solid, in local space.
  virtual Vector<Exact> middle(const csgcore::Primitive& primitive) const = 0;
  /// Sets the target's wall and planes, and its weight; λ (see exact_primitive.hpp) is
  /// `magnification`.
  virtual void add_surfaces(const csgcore::Primitive& primitive, const Exact& magnification,
                            Target<Exact>& target) const = 0;
  /// The walls of a ray, o + t·d in the target's local space; all zero if the kind has none.
  virtual Walls<Exact> walls(const Target<Exact>& target, const Vector<Exact>& o,
                             const Vector<Exact>& d) const;
  virtual Walls<Interval> walls(const Target<Interval>& target, const Vector<Interval>& o,
                                const Vector<Interval>& d) const;
  /// Half the gradient of the wall at a local point.
  virtual Vector<Interval> wall_normal(const Target<Interval>& target,
                                       const Vector<Interval>& point) const;
  /// Makes the box hold the primitive, relative to a point of the world: tight, and wider by no
  /// more than rounding. RoundingUp is on.
  virtual void merge_box(const csgcore::Vec3& point, const csgcore::Primitive& primitive,
                         csgcore::Box& box) const = 0;

  /// The solid's half-spaces in local space; what is round has that many fragments around.
  virtual std::vector<csgcore::HalfSpace> half_spaces(const csgcore::Primitive& primitive,
                                                      int fragments) const = 0;

  /// The C++ expression that makes the primitive; `map` is that of its matrix.
  virtual std::string as_cpp(const csgcore::Primitive& primitive, const std::string& map) const = 0;
  /// The OpenSCAD expression of the local solid.
  virtual std::string as_openscad(const csgcore::Primitive& primitive) const = 0;

  /// Sizes that a search for a smaller scene may change.
  virtual std::vector<double*> sizes(csgcore::Primitive& primitive) const = 0;
  /// Simpler primitives with the same matrix, the simplest one first.
  virtual std::vector<csgcore::Primitive> simpler(const csgcore::Primitive& primitive) const = 0;

 protected:
  ~ExactTwin() = default;
};

const ExactTwin& twin_of(csgcore::Shape shape);

}  // namespace oracle
