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
    return primitive.profile != nullptr && primitive.profile->has_area() &&
           kind_of(Shape::kFrustum).has_valid_shape(primitive);
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    const Profile& profile = *primitive.profile;
    CanonicalPrimitive result;
    result.shape = Shape::kExtrusion;
    result.enclosure = Shape::kFrustum;
    result.is_convex = false;
    result.shared_shape = primitive.profile;
    const double scale = std::max(primitive.r_bottom, primitive.r_top);
    const double half_height = 0.5 * (primitive.z_max - primitive.z_min);
    const double middle = 0.5 * primitive.z_min + 0.5 * primitive.z_max;
    result.radius_mid = 0.5 * (primitive.r_bottom / scale + primitive.r_top / scale);
    result.radius_slope = 0.5 * (primitive.r_top / scale - primitive.r_bottom / scale);
    // The profile's middle, scaled, leads along a line that leans if it is not on the axis.
    const Vec2 place = scale * profile.center();
    const Vec2 half = scale * profile.reach() * profile.half();
    const double mid = result.radius_mid, slope = result.radius_slope;
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point({mid * place.x, mid * place.y, middle});
    result.canonical_to_world = Mat3{linear[0] * half.x, linear[1] * half.y,
                                     linear * Vec3{slope * place.x, slope * place.y, half_height}};
    result.world_to_canonical = inverse(result.canonical_to_world);
    result.bounds = bounds_of(result);
    return result;
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

Primitive make_extrusion(std::shared_ptr<const Profile> profile, double z_min, double z_max,
                         double scale_bottom, double scale_top, const Affine& local_to_world) {
  Primitive primitive;
  primitive.shape = Shape::kExtrusion;
  primitive.profile = std::move(profile);
  primitive.z_min = z_min;
  primitive.z_max = z_max;
  primitive.r_bottom = scale_bottom;
  primitive.r_top = scale_top;
  primitive.local_to_world = local_to_world;
  return primitive;
}

}  // namespace csgcore
