// The exact twin of the sphere.
#include "disc_box.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"

namespace oracle {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;

double radius_of(const Primitive& sphere) { return sphere.as<csgcore::SphereShape>().radius; }

template <class Number>
Walls<Number> walls_of_sphere(const Target<Number>& target, const Vector<Number>& o,
                              const Vector<Number>& d) {
  Quadratic<Number> wall;
  const Number radius2 = CGAL::square(target.radius);
  wall.a = dot(d, d);
  wall.b = dot(o, d);
  wall.c = dot(o, o) - radius2;
  // Lagrange's identity avoids the squares of o, which would cancel.
  const Vector<Number> moment = cross(o, d);
  wall.discriminant = radius2 * wall.a - dot(moment, moment);
  return {wall, wall};
}

class SphereTwin final : public ExactTwin {
 public:
  Vector<Exact> middle(const Primitive&) const override { return {0, 0, 0}; }
  void add_surfaces(const Primitive& primitive, const Exact& magnification,
                    Target<Exact>& target) const override {
    target.has_wall = true;
    target.radius = magnification * Exact(radius_of(primitive));
    target.weight = Vec3(1.0);
  }
  Walls<Exact> walls(const Target<Exact>& target, const Vector<Exact>& o,
                     const Vector<Exact>& d) const override {
    return walls_of_sphere(target, o, d);
  }
  Walls<Interval> walls(const Target<Interval>& target, const Vector<Interval>& o,
                        const Vector<Interval>& d) const override {
    return walls_of_sphere(target, o, d);
  }
  Vector<Interval> wall_normal(const Target<Interval>&,
                               const Vector<Interval>& point) const override {
    return point;
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    merge_ball(point, primitive.local_to_world, radius_of(primitive), box);
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    return "make_sphere(" + shortest_text(radius_of(primitive)) + ", " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    return "sphere(" + shortest_text(radius_of(primitive)) + ")";
  }
  std::vector<double*> sizes(Primitive& primitive) const override {
    return {&primitive.as<csgcore::SphereShape>().radius};
  }
  std::vector<Primitive> simpler(const Primitive&) const override { return {}; }
};

constexpr SphereTwin kSphereTwin;

}  // namespace

constinit const ExactTwin& Sphere_twin = kSphereTwin;

}  // namespace oracle
