// The test kind of the frustum, for cylinders and for cones with a point at either end.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"

namespace test_support {
namespace {

using csgcore::FrustumShape;
using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;
using csgcore::reference::ConvexSolid;
using csgcore::reference::LocalSolid;
using csgcore::reference::NearRay;
using csgcore::reference::Span;
using csgcore::reference::Surface;
using csgcore::reference::Wide;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// Solves f(t) = a·t² + 2b·t + c ≤ 0 for a cone, on the nappe of positive radius. For a > 0 the
/// solution is one segment. For a < 0 it is a half-line in each nappe, and the growth of the radius
/// along the ray tells which is ours. For a = 0 it is one half-line.
Span solve_cone(Real a, Real b, Real c, Real growth) {
  if (a == 0) {
    if (b == 0) return c <= 0 ? Span{-kInfinity, kInfinity} : Span{};
    return b > 0 ? Span{-kInfinity, -c / (2 * b)} : Span{-c / (2 * b), kInfinity};
  }
  Real discriminant = b * b - a * c;
  if (discriminant < 0) {
    if (a > 0) return {};
    discriminant = 0;  // by rounding: at the apex's height f ≥ 0, so that there are roots for a < 0
  }
  const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return a > 0 ? Span{} : growth > 0 ? Span{0, kInfinity} : Span{-kInfinity, 0};
  const Real low = std::min(q / a, c / q), high = std::max(q / a, c / q);
  if (a > 0) return {low, high};
  return growth > 0 ? Span{high, kInfinity} : Span{-kInfinity, low};
}

/// The part of the ray with |z| ≤ half_height; a ray along the end planes belongs to it.
Span cross_slab(const NearRay& ray, Real half_height) {
  if (ray.direction.z == 0) {
    const bool inside = std::abs(ray.origin.z) <= half_height;
    return inside ? Span{-kInfinity, kInfinity} : Span{};
  }
  const Real at_bottom = (-half_height - ray.origin.z) / ray.direction.z;
  const Real at_top = (half_height - ray.origin.z) / ray.direction.z;
  if (at_bottom < at_top) return {at_bottom, at_top, Surface::kBottom, Surface::kTop};
  return {at_top, at_bottom, Surface::kTop, Surface::kBottom};
}

/// Measures z from the middle.
class FrustumSolid final : public ConvexSolid {
 public:
  explicit FrustumSolid(const FrustumShape& p)
      : middle_z_((Wide(p.z_min) + Wide(p.z_max)) / 2),
        half_height_(Real((Wide(p.z_max) - Wide(p.z_min)) / 2)),
        r_bottom_(p.r_bottom),
        r_top_(p.r_top),
        slope_((r_top_ - r_bottom_) / (2 * half_height_)) {}

  Wide middle_z() const override { return middle_z_; }

  Span span(const NearRay& ray) const override {
    Span span = cross_slab(ray, half_height_);
    if (span.empty()) return span;
    // The wall is solved from the ray's point nearest to the axis within the slab, so that
    // differences are of the primitive's own size, however long and thin it is.
    const LongVec3& d = ray.direction;
    const Real dd = d.x * d.x + d.y * d.y;
    const Real next_to_axis = dd > 0 ? -(ray.origin.x * d.x + ray.origin.y * d.y) / dd : Real(0);
    const Real base = std::clamp(next_to_axis, span.begin, span.end);
    const LongVec3 o = ray.origin + base * d;
    const Real radius = radius_at(o.z), growth = slope_ * d.z;
    const Span side = solve_cone(dd - growth * growth, o.x * d.x + o.y * d.y - radius * growth,
                                 o.x * o.x + o.y * o.y - radius * radius, growth);
    if (side.empty()) return {};
    const Real begin = base + side.begin, end = base + side.end;
    if (begin > span.begin) span.begin = begin, span.begin_surface = Surface::kSide;
    if (end < span.end) span.end = end, span.end_surface = Surface::kSide;
    return span;
  }

  LongVec3 normal(const LongVec3& point, Surface surface) const override {
    if (surface == Surface::kBottom) return {0, 0, -1};
    if (surface == Surface::kTop) return {0, 0, 1};
    const LongVec3 normal{point.x, point.y, -slope_ * std::hypot(point.x, point.y)};
    // At the very apex all directions on the cone are equally valid: the axis is taken.
    return normal == LongVec3(0) ? LongVec3(0, 0, r_top_ == 0 ? 1 : -1) : normal;
  }

 private:
  /// The radius is computed from the nearer end, so that nothing cancels next to an apex.
  Real radius_at(Real z) const {
    return z > 0 ? r_top_ + slope_ * (z - half_height_) : r_bottom_ + slope_ * (z + half_height_);
  }

  const Wide middle_z_;
  const Real half_height_, r_bottom_, r_top_, slope_;
};

/// Places the frustum around the local origin, on it, or beyond it.
Primitive standing(Sizes& sizes, double r_bottom, double r_top) {
  const double height = sizes.length();
  if (sizes.by_chance(0.5)) return csgcore::make_frustum(-sizes.length(), height, r_bottom, r_top);
  const double bottom = sizes.by_chance(0.5) ? 0 : sizes.length();
  return csgcore::make_frustum(bottom, bottom + height, r_bottom, r_top);
}

constexpr Variant kVariants[] = {
    {"Cylinder",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return standing(sizes, radius, radius);
     }},
    {"Frustum",
     [](Sizes& sizes) {
       const double r_bottom = sizes.length();
       return standing(sizes, r_bottom, sizes.length());
     }},
    {"Cone", [](Sizes& sizes) { return standing(sizes, sizes.length(), 0); }},
    {"ConeUpsideDown", [](Sizes& sizes) { return standing(sizes, 0, sizes.length()); }},
    {"HardlyACone", [](Sizes& sizes) { return standing(sizes, 1, 1 - 1e-12); }}};

double radius_at(const FrustumShape& p, double z) {
  return p.r_bottom + (z - p.z_min) / (p.z_max - p.z_min) * (p.r_top - p.r_bottom);
}

class FrustumTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }

  bool holds(const Primitive& primitive, const Vec3& point) const override {
    const auto& p = primitive.as<FrustumShape>();
    return point.z >= p.z_min && point.z <= p.z_max &&
           std::hypot(point.x, point.y) <= radius_at(p, point.z);
  }
  Vec3 surface_point(const Primitive& primitive, std::mt19937& random) const override {
    const auto& p = primitive.as<FrustumShape>();
    std::uniform_real_distribution<double> share(0, 1);
    const double angle = 2 * std::numbers::pi * share(random);
    const bool at_end = random() % 2 == 0, at_top = random() % 2 == 0;
    const double z = !at_end  ? p.z_min + share(random) * (p.z_max - p.z_min)
                     : at_top ? p.z_max
                              : p.z_min;
    double radius = at_end ? (at_top ? p.r_top : p.r_bottom) : radius_at(p, z);
    if (at_end && random() % 3 == 0) radius *= std::sqrt(share(random));  // in the cap, not its rim
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
  Vec3 core(const Primitive& primitive, const Vec3&) const override {
    const auto& p = primitive.as<FrustumShape>();
    return {0, 0, 0.5 * p.z_min + 0.5 * p.z_max};
  }

  LongVec3 middle(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    return {0, 0, (Real(p.z_max) + Real(p.z_min)) / 2};
  }
  Real reach_world(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    const csgcore::Mat3& linear = primitive.local_to_world.linear;
    const Real radius = std::max(p.r_bottom, p.r_top);
    const Real half_height = (Real(p.z_max) - Real(p.z_min)) / 2;
    return glm::length(LongVec3(linear[0])) * radius + glm::length(LongVec3(linear[1])) * radius +
           glm::length(LongVec3(linear[2])) * half_height;
  }
  std::vector<Side> sides(const Primitive& primitive, const LongVec3& point) const override {
    const auto& p = primitive.as<FrustumShape>();
    const Real above = point.z - p.z_max, below = p.z_min - point.z;
    const Real slope = (Real(p.r_top) - Real(p.r_bottom)) / (Real(p.z_max) - Real(p.z_min));
    // The radius is computed from the nearer end, so that nothing cancels next to an apex.
    const Real radius = above > below ? p.r_top + slope * above : p.r_bottom - slope * below;
    const Real across = std::hypot(point.x, point.y);
    const LongVec3 outwards =
        across > 0 ? LongVec3(point.x, point.y, 0) / across : LongVec3(1, 0, 0);
    std::vector<Side> sides{{across - radius, outwards - LongVec3(0, 0, slope)}};
    // At a pointed end only the wall bounds the primitive.
    if (p.r_top > 0) sides.push_back({above, {0, 0, 1}});
    if (p.r_bottom > 0) sides.push_back({below, {0, 0, -1}});
    return sides;
  }

  std::unique_ptr<const LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<FrustumSolid>(p.as<FrustumShape>());
  }
  double furthest(const Primitive& primitive, const Vec3& direction) const override {
    const auto& p = primitive.as<FrustumShape>();
    const double across = std::hypot(direction.x, direction.y);
    return std::max(direction.z * p.z_min + across * p.r_bottom,
                    direction.z * p.z_max + across * p.r_top);
  }

  Heights heights(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    return {p.z_min, p.z_max};
  }
  Vec3 on_surface(const Primitive& primitive, const Vec3& sideways, double height) const override {
    const auto& p = primitive.as<FrustumShape>();
    return radius_at(p, height) * sideways + Vec3{0, 0, height};
  }
  std::optional<double> apex(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    if (p.r_top == p.r_bottom) return std::nullopt;
    return p.z_min + (p.z_max - p.z_min) * p.r_bottom / (p.r_bottom - p.r_top);
  }

  std::string as_povray(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    const std::string bottom = povray::vector({0, 0, p.z_min});
    const std::string top = povray::vector({0, 0, p.z_max});
    const std::string r_bottom = povray::number(p.r_bottom), r_top = povray::number(p.r_top);
    if (p.r_bottom == p.r_top) return "cylinder { " + bottom + "," + top + "," + r_bottom;
    return "cone { " + bottom + "," + r_bottom + "," + top + "," + r_top;
  }
  std::optional<FacetedSolid> faceted(const Primitive& primitive, int fragments) const override {
    const auto& p = primitive.as<FrustumShape>();
    return FacetedSolid{
        csgcore::frustum_mesh(p.z_min, p.z_max, p.r_bottom, p.r_top, fragments),
        half_spaces(csgcore::faceted_frustum(p.z_min, p.z_max, p.r_bottom, p.r_top, fragments))};
  }
};

constexpr FrustumTestKind kTestKind;

}  // namespace

constinit const TestKind& Frustum_test_kind = kTestKind;

}  // namespace test_support
