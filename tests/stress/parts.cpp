#include "parts.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "csgcore/polyhedron.hpp"

namespace stress {

using csgcore::HalfSpace;
using csgcore::Polyhedron;

Part::Part(const Primitive& primitive)
    : primitives_{primitive}, steps_{{Step::Kind::kPrimitive, Op::kUnion, 0}} {}

void Part::append(const Part& part) {
  const auto base = static_cast<uint32_t>(primitives_.size());
  primitives_.insert(primitives_.end(), part.primitives_.begin(), part.primitives_.end());
  for (Step step : part.steps_) {
    step.primitive += base;
    steps_.push_back(step);
  }
}

Part Part::combined(Op op, std::vector<Part> operands) {
  Part result;
  result.steps_.push_back({Step::Kind::kOpen, op, 0});
  for (const Part& operand : operands) result.append(operand);
  result.steps_.push_back({Step::Kind::kClose, op, 0});
  return result;
}

Part Part::under(const Affine& map) const {
  Part result = *this;
  for (Primitive& p : result.primitives_) {
    p.local_to_world = csgcore::compose(map, p.local_to_world);
  }
  return result;
}

Scene Part::scene() const {
  Scene scene;
  scene.primitives = primitives_;
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) scene.primitives[i].id = i;
  csgcore::CsgTreeBuilder builder;
  for (const Step& step : steps_) {
    if (step.kind == Step::Kind::kOpen) builder.open(step.op);
    if (step.kind == Step::Kind::kPrimitive) builder.primitive(step.primitive);
    if (step.kind == Step::Kind::kClose) builder.close();
  }
  scene.model = builder.finish();
  return scene;
}

void Nest::wrap(Op op, const Part& other) {
  ops_.push_back(op);
  part_.append(other);
  part_.steps_.push_back({Part::Step::Kind::kClose, op, 0});
}

Scene Nest::scene() const {
  // The innermost part comes first, so that all operations open before it, the outermost one first.
  Part whole;
  for (size_t i = ops_.size(); i-- > 0;) {
    whole.steps_.push_back({Part::Step::Kind::kOpen, ops_[i], 0});
  }
  whole.append(part_);
  return whole.scene();
}

Part operator+(const Part& a, const Part& b) { return Part::combined(Op::kUnion, {a, b}); }
Part operator-(const Part& a, const Part& b) { return Part::combined(Op::kDifference, {a, b}); }
Part operator*(const Part& a, const Part& b) { return Part::combined(Op::kIntersection, {a, b}); }
Part all_of(std::vector<Part> parts) { return Part::combined(Op::kUnion, std::move(parts)); }
Part common_of(std::vector<Part> parts) {
  return Part::combined(Op::kIntersection, std::move(parts));
}

Part ball(double radius, const Vec3& at) { return csgcore::make_sphere(radius, {Mat3{1.0}, at}); }
Part rod(double z_min, double z_max, double radius, const Vec3& at) {
  return csgcore::make_frustum(z_min, z_max, radius, radius, {Mat3{1.0}, at});
}
Part cone(double z_min, double z_max, double r_bottom, double r_top, const Vec3& at) {
  return csgcore::make_frustum(z_min, z_max, r_bottom, r_top, {Mat3{1.0}, at});
}

Part mesh(const test_support::MeshParts& parts) { return csgcore::make_mesh(parts.mesh()); }

Part brick(const Vec3& min, const Vec3& max) {
  return csgcore::make_polyhedron(Polyhedron::box({min, max}));
}
Part cube(double size, const Vec3& at) { return brick(at - 0.5 * size, at + 0.5 * size); }
Part prism(double z_min, double z_max, double radius, int fragments, const Vec3& at) {
  return csgcore::make_polyhedron(Polyhedron::frustum(z_min, z_max, radius, radius, fragments),
                                  {Mat3{1.0}, at});
}
Part faceted_ball(double radius, int fragments, const Vec3& at) {
  return csgcore::make_polyhedron(Polyhedron::sphere(radius, fragments), {Mat3{1.0}, at});
}

Part dodecahedron(double scale) {
  constexpr double kPhi = std::numbers::phi;
  std::vector<HalfSpace> faces;
  std::vector<Vec3> vertices;
  const auto turned_thrice = [](const Vec3& v, int times) {
    return Vec3{v[(3 - times) % 3], v[(4 - times) % 3], v[(5 - times) % 3]};
  };
  for (int signs = 0; signs < 4; ++signs) {
    const double s = signs & 1 ? -1 : 1, t = signs & 2 ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis) {
      faces.push_back({turned_thrice({0, s * kPhi, t}, axis), scale * (1 + kPhi)});
      vertices.push_back(scale * turned_thrice({0, s / kPhi, t * kPhi}, axis));
    }
    vertices.push_back(scale * Vec3{s, t, 1});
    vertices.push_back(scale * Vec3{s, t, -1});
  }
  return csgcore::make_polyhedron(std::make_shared<Polyhedron>(faces, vertices));
}

Mat3 turned(double x_deg, double y_deg, double z_deg) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  const double cx = std::cos(radians(x_deg)), sx = std::sin(radians(x_deg));
  const double cy = std::cos(radians(y_deg)), sy = std::sin(radians(y_deg));
  const double cz = std::cos(radians(z_deg)), sz = std::sin(radians(z_deg));
  const Mat3 about_x{Vec3{1, 0, 0}, Vec3{0, cx, sx}, Vec3{0, -sx, cx}};
  const Mat3 about_y{Vec3{cy, 0, -sy}, Vec3{0, 1, 0}, Vec3{sy, 0, cy}};
  const Mat3 about_z{Vec3{cz, sz, 0}, Vec3{-sz, cz, 0}, Vec3{0, 0, 1}};
  return about_z * about_y * about_x;
}

Affine turn(double x_deg, double y_deg, double z_deg) {
  return {turned(x_deg, y_deg, z_deg), Vec3{0.0}};
}

}  // namespace stress
