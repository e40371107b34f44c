// The oracles' interface to a kind of primitive: its exact twin. Each kind implements it in one
// file, sphere_twin.cpp and so on. CSGCORE_FOR_EACH_SHAPE (csgcore/shape.hpp) lists the kinds, and
// a kind without a twin does not link.
#pragma once

#include <string>
#include <vector>

#include "csgcore/primitive.hpp"
#include "exact_primitive.hpp"

namespace oracle {

/// The exact twin of a kind. All functions take valid primitives of that kind.
class ExactTwin {
 public:
  /// Returns a point well inside the solid, in local space.
  virtual Vector<Exact> middle(const csgcore::Primitive& primitive) const = 0;
  /// Sets the target's wall, planes and weight. `magnification` is λ of exact_primitive.hpp.
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
  /// Extends the box, which is relative to a world point, by the primitive: tightly, but for
  /// outward rounding. RoundingUp must be on.
  virtual void merge_box(const csgcore::Vec3& point, const csgcore::Primitive& primitive,
                         csgcore::Box& box) const = 0;

  /// Returns the C++ expression that makes the primitive. `map` is the expression of its matrix.
  virtual std::string as_cpp(const csgcore::Primitive& primitive, const std::string& map) const = 0;
  /// Returns the OpenSCAD expression of the local solid.
  virtual std::string as_openscad(const csgcore::Primitive& primitive) const = 0;

  /// Returns the primitive's sizes, which minimise() may change; by default none.
  virtual std::vector<double*> sizes(csgcore::Primitive& primitive) const;
  /// Returns simpler primitives with the same matrix, the simplest one first; by default a sphere.
  virtual std::vector<csgcore::Primitive> simpler(const csgcore::Primitive& primitive) const;

 protected:
  ~ExactTwin() = default;
};

const ExactTwin& twin_of(csgcore::Shape shape);

}  // namespace oracle
