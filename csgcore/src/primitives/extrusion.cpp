// The profile that is extruded, under affine maps. profile.hpp describes its canonical space.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "csgcore/profile.hpp"
#include "primitives/primitive_kind.hpp"

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
    const Mat3 rows = glm::transpose(result.canonical_to_world);
    for (int axis = 0; axis < 3; ++axis) {
      result.bounds.min[axis] = result.center[axis] - reach(result, -rows[axis]);
      result.bounds.max[axis] = result.center[axis] + reach(result, rows[axis]);
    }
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

 private:
  double reach(const CanonicalPrimitive& primitive, const Vec3& direction) const {
    return glm::dot(direction, support(primitive, direction));
  }
};

constexpr ExtrusionKind kKind;

}  // namespace

constinit const PrimitiveKind& Extrusion_kind = kKind;

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
