// The profile that is extruded, under affine maps. profile.hpp describes its canonical space.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "csgcore/profile.hpp"
#include "primitives/primitive_kind.hpp"
#include "primitives/profile_cells.hpp"

namespace csgcore {
namespace {

class ExtrusionKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    const auto& [profile, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
    return profile != nullptr && profile->has_area() &&
           kind_of(Shape::kFrustum).has_valid_shape(make_frustum(z_min, z_max, bottom, top));
  }

  bool has_same_solid(const Primitive& a, const Primitive& b) const override {
    ExtrusionShape with_profile_of_b = a.as<ExtrusionShape>();
    with_profile_of_b.profile = b.as<ExtrusionShape>().profile;
    return with_profile_of_b == b.as<ExtrusionShape>() && same_profile(a.profile(), b.profile());
  }
  bool has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const override {
    return same_profile(a.profile(), b.profile());
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    const auto& [shared, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
    const Profile& profile = *shared;
    CanonicalPrimitive result;
    result.enclosure = Shape::kFrustum;
    result.shared_shape = shared;
    const double scale = std::max(bottom, top);
    const double half_height = 0.5 * (z_max - z_min);
    const double middle = 0.5 * z_min + 0.5 * z_max;
    result.radius_mid = 0.5 * (bottom / scale + top / scale);
    result.radius_slope = 0.5 * (top / scale - bottom / scale);
    // The profile's middle, scaled, leads along a line that leans if it is not on the axis.
    const Vec2 place = scale * profile.center();
    const Vec2 half = scale * profile.reach() * profile.half();
    const double mid = result.radius_mid, slope = result.radius_slope;
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point({mid * place.x, mid * place.y, middle});
    result.canonical_to_world = Mat3{linear[0] * half.x, linear[1] * half.y,
                                     linear * Vec3{slope * place.x, slope * place.y, half_height}};
    result.world_to_canonical = inverse(result.canonical_to_world);
    return result;
  }

  /// The radii of the figure's scale.
  std::array<double, 2> shader_numbers(const CanonicalPrimitive& primitive) const override {
    const double unit = 1 / primitive.profile()->reach();
    return {unit * primitive.radius_mid, unit * primitive.radius_slope};
  }

  Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const override {
    const Profile& profile = *primitive.profile();
    const Vec2 furthest = profile.support({direction.x, direction.y});
    const double lateral = glm::dot(Vec2{direction.x, direction.y}, furthest) / profile.reach();
    const double end = direction.z + lateral * primitive.radius_slope >= 0 ? 1 : -1;
    const double scale = (primitive.radius_mid + end * primitive.radius_slope) / profile.reach();
    return {scale * furthest.x, scale * furthest.y, end};
  }

  bool contains(const CanonicalPrimitive& primitive, const Vec3& p) const override {
    const Profile& profile = *primitive.profile();
    const double scale = (primitive.radius_mid + primitive.radius_slope * p.z) / profile.reach();
    return std::abs(p.z) <= 1 && scale > 0 && profile.contains({p.x / scale, p.y / scale});
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    const Profile& profile = *primitive.profile();
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    const Vec3 half = cell.half_box();
    const double bottom = std::max(-1.0, cell.center.z - half.z);
    const double top = std::min(1.0, cell.center.z + half.z);
    if (bottom > top) return Classification::kOutside;
    const auto scale_at = [&](double z) {
      constexpr double kPositive = 1e-100;  // so that no quotient is infinite
      const double scale = primitive.radius_mid + primitive.radius_slope * z;
      return std::max(kPositive, scale / profile.reach());
    };
    const double scales[] = {scale_at(bottom), scale_at(top)};
    const Vec2 center(cell.center), low = center - Vec2(half), high = center + Vec2(half);
    const Rectangle rectangle{glm::min(low / scales[0], low / scales[1]),
                              glm::max(high / scales[0], high / scales[1])};
    const double middle = std::clamp(cell.center.z, bottom, top);
    constexpr double kNowhere = -std::numeric_limits<double>::infinity();
    const Classification figure =
        csgcore::classify(profile, rectangle, center / scale_at(middle), kNowhere);
    const bool is_between = cell.center.z - half.z > -1 && cell.center.z + half.z < 1;
    return figure != Classification::kInside || is_between ? figure : Classification::kCrosses;
  }
};

constexpr ExtrusionKind kExtrusionKind;

}  // namespace

constinit const PrimitiveKind& Extrusion_kind = kExtrusionKind;

}  // namespace csgcore
