// The test kind of the sphere.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"

namespace test_support {
namespace {

using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;
using csgcore::reference::ConvexSolid;
using csgcore::reference::LocalSolid;
using csgcore::reference::NearRay;
using csgcore::reference::Span;
using csgcore::reference::Surface;

double radius_of(const Primitive& sphere) { return sphere.as<csgcore::SphereShape>().radius; }

class SphereSolid final : public ConvexSolid {
 public:
  explicit SphereSolid(const Primitive& primitive) : radius_(radius_of(primitive)) {}

  Span span(const NearRay& ray) const override {
    const Real dd = glm::dot(ray.direction, ray.direction);
    const Real closest = -glm::dot(ray.origin, ray.direction) / dd;
    const LongVec3 foot = ray.origin + closest * ray.direction;
    const Real half_squared = (radius_ * radius_ - glm::dot(foot, foot)) / dd;
    if (!(half_squared > 0)) return {};
    const Real half = std::sqrt(half_squared);
    return {closest - half, closest + half};
  }
  LongVec3 normal(const LongVec3& point, Surface) const override { return point; }

 private:
  const Real radius_;
};

constexpr Variant kVariants[] = {
    {"Sphere", [](Sizes& sizes) { return csgcore::make_sphere(sizes.length()); }}};

class SphereTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }

  bool holds(const Primitive& p, const Vec3& point) const override {
    return glm::length(point) <= radius_of(p);
  }
  Vec3 surface_point(const Primitive& p, std::mt19937& random) const override {
    return radius_of(p) * random_direction(random);
  }
  Vec3 core(const Primitive&, const Vec3&) const override { return Vec3(0.0); }

  LongVec3 middle(const Primitive&) const override { return LongVec3(0); }
  Real reach_world(const Primitive& p) const override {
    Real reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      reach += glm::length(LongVec3(p.local_to_world.linear[axis])) * Real(radius_of(p));
    }
    return reach;
  }
  std::vector<Side> sides(const Primitive& p, const LongVec3& point) const override {
    const Real length = glm::length(point);
    return {{length - radius_of(p), length > 0 ? point / length : LongVec3(1)}};
  }

  std::unique_ptr<const LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<SphereSolid>(p);
  }
  double furthest(const Primitive& p, const Vec3& direction) const override {
    return radius_of(p) * glm::length(direction);
  }

  Heights heights(const Primitive& p) const override { return {-radius_of(p), radius_of(p)}; }
  Vec3 on_surface(const Primitive& p, const Vec3& sideways, double height) const override {
    const double radius = std::sqrt(std::max(0.0, radius_of(p) * radius_of(p) - height * height));
    return radius * sideways + Vec3{0, 0, height};
  }
  Vec3 upwards(const Primitive&, const Vec3& sideways, const Vec3& point) const override {
    return glm::cross(point, Vec3{-sideways.y, sideways.x, 0});
  }

  std::string as_povray(const Primitive& p) const override {
    return "sphere { <0,0,0>," + povray::number(radius_of(p));
  }
  std::optional<FacetedSolid> faceted(const Primitive& p, int fragments) const override {
    return FacetedSolid{csgcore::sphere_mesh(radius_of(p), fragments),
                        half_spaces(csgcore::faceted_sphere(radius_of(p), fragments))};
  }
};

constexpr SphereTestKind kTestKind;

}  // namespace

constinit const TestKind& Sphere_test_kind = kTestKind;

}  // namespace test_support
