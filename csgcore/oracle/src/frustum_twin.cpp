// The exact twin of the frustum: cylinders, and cones with either end pointed.
#include <cmath>

#include "disc_box.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"

namespace oracle {
namespace {

using csgcore::FrustumShape;
using csgcore::Primitive;
using csgcore::Vec3;

/// The dot product across the axis.
template <class Number>
Number dot_across(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

/// ρ(z).
template <class Number>
Number radius_at(const Target<Number>& target, const Number& z) {
  return target.radius + target.growth * z;
}

template <class Number>
Walls<Number> walls_of_frustum(const Target<Number>& target, const Vector<Number>& o,
                               const Vector<Number>& d) {
  Quadratic<Number> wall;
  const Number& w = target.squared_height;
  const Number radius = radius_at(target, o[2]), growth = target.growth * d[2];
  wall.a = w * dot_across(d, d) - CGAL::square(growth);
  wall.b = w * dot_across(o, d) - radius * growth;
  wall.c = w * dot_across(o, o) - CGAL::square(radius);
  // As for a sphere, this form does not cancel: w(|ρd − go|² − w(o × d)²) across the axis, where g
  // is the growth of ρ along the ray.
  const Number x = radius * d[0] - growth * o[0], y = radius * d[1] - growth * o[1];
  const Number moment = o[0] * d[1] - o[1] * d[0];
  wall.discriminant = w * (CGAL::square(x) + CGAL::square(y) - w * CGAL::square(moment));
  return {wall, wall};
}

class FrustumTwin final : public ExactTwin {
 public:
  Vector<Exact> middle(const Primitive& primitive) const override {
    const auto& shape = primitive.as<FrustumShape>();
    return {0, 0, Exact(0.5) * (Exact(shape.z_min) + Exact(shape.z_max))};
  }
  void add_surfaces(const Primitive& primitive, const Exact& magnification,
                    Target<Exact>& target) const override {
    const auto& shape = primitive.as<FrustumShape>();
    const Exact half(0.5), bottom(shape.z_min), top(shape.z_max);
    const Exact r_bottom(shape.r_bottom), r_top(shape.r_top);
    const Exact wall_scale = power_of_two(-std::ilogb(shape.z_max - shape.z_min));
    const Exact half_height = magnification * half * (top - bottom);
    target.has_wall = true;
    target.growth = wall_scale * (r_top - r_bottom);
    target.squared_height = CGAL::square(Exact(wall_scale * (top - bottom)));
    target.radius = wall_scale * half_height * (r_bottom + r_top);
    target.planes = {{{0, 0, -1}, half_height}, {{0, 0, 1}, half_height}};
    target.weight = {1, 1, 0};
  }
  Walls<Exact> walls(const Target<Exact>& target, const Vector<Exact>& o,
                     const Vector<Exact>& d) const override {
    return walls_of_frustum(target, o, d);
  }
  Walls<Interval> walls(const Target<Interval>& target, const Vector<Interval>& o,
                        const Vector<Interval>& d) const override {
    return walls_of_frustum(target, o, d);
  }
  Vector<Interval> wall_normal(const Target<Interval>& target,
                               const Vector<Interval>& point) const override {
    return {target.squared_height * point[0], target.squared_height * point[1],
            -target.growth * radius_at(target, point[2])};
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    const auto& p = primitive.as<FrustumShape>();
    merge_disc(point, primitive.local_to_world, p.z_min, p.r_bottom, box);
    merge_disc(point, primitive.local_to_world, p.z_max, p.r_top, box);
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    const auto& p = primitive.as<FrustumShape>();
    return "make_frustum(" + joined({p.z_min, p.z_max, p.r_bottom, p.r_top}) + ", " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    return "translate([" + joined({0, 0, p.z_min}) + "]) cylinder(" +
           joined({p.z_max - p.z_min, p.r_bottom, p.r_top}) + ")";
  }
  std::vector<double*> sizes(Primitive& primitive) const override {
    auto& p = primitive.as<FrustumShape>();
    return {&p.r_bottom, &p.r_top, &p.z_min, &p.z_max};
  }
};

constexpr FrustumTwin kFrustumTwin;

}  // namespace

constinit const ExactTwin& Frustum_twin = kFrustumTwin;

}  // namespace oracle
