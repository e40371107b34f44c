// Composes solids of parts, for the scenes of the stress suite.
#pragma once

#include <vector>

#include "csgcore/scene.hpp"
#include "support/test_meshes.hpp"

namespace stress {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Vec3;

/// A solid: its primitives, and the calls that build it with a CsgTreeBuilder, in order. Parts may
/// nest to any depth, since no function recurses.
class Part {
 public:
  Part() = default;
  Part(const Primitive& primitive);  // NOLINT: a primitive is a part

  static Part combined(Op op, std::vector<Part> operands);
  /// The same solid under a further map.
  Part under(const Affine& map) const;
  Part at(const Vec3& offset) const { return under({Mat3{1.0}, offset}); }
  /// Returns a scene with this model; ids are the primitives' indices.
  Scene scene() const;
  size_t primitive_count() const { return primitives_.size(); }

 private:
  struct Step {
    enum class Kind : uint8_t { kOpen, kPrimitive, kClose } kind;
    Op op = Op::kUnion;
    uint32_t primitive = 0;
  };
  void append(const Part& part);

  std::vector<Primitive> primitives_;
  std::vector<Step> steps_;
  friend class Nest;
};

/// A part that grows outwards in constant time a step: each step puts an operation around the part.
class Nest {
 public:
  explicit Nest(const Part& innermost) : part_(innermost) {}
  /// Makes the part so far and `other` the operands of `op`, in this order.
  void wrap(Op op, const Part& other);
  Scene scene() const;

 private:
  Part part_;
  std::vector<Op> ops_;  // from the inside out
};

Part operator+(const Part& a, const Part& b);
Part operator-(const Part& a, const Part& b);
Part operator*(const Part& a, const Part& b);
Part all_of(std::vector<Part> parts);     // union
Part common_of(std::vector<Part> parts);  // intersection

Part ball(double radius, const Vec3& at = Vec3{0.0});
Part rod(double z_min, double z_max, double radius, const Vec3& at = Vec3{0.0});
Part cone(double z_min, double z_max, double r_bottom, double r_top, const Vec3& at = Vec3{0.0});

Part mesh(const test_support::MeshParts& parts);

// Convex polyhedra.
Part brick(const Vec3& min, const Vec3& max);
Part cube(double size, const Vec3& at = Vec3{0.0});  // centred
Part prism(double z_min, double z_max, double radius, int fragments, const Vec3& at = Vec3{0.0});
Part faceted_ball(double radius, int fragments, const Vec3& at = Vec3{0.0});
/// A dodecahedron about the origin. Its outermost coordinate is φ·`scale`, and eight of its
/// vertices are the corners of the cube of ±`scale`.
Part dodecahedron(double scale);

/// Rotations about the axes, in this order, as in OpenSCAD's rotate([x, y, z]); rounded.
Mat3 turned(double x_deg, double y_deg, double z_deg);
Affine turn(double x_deg, double y_deg, double z_deg);

}  // namespace stress
