// The profile that is revolved, under affine maps. profile.hpp describes its canonical space.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "csgcore/profile.hpp"
#include "primitives/primitive_kind.hpp"
#include "primitives/profile_cells.hpp"

namespace csgcore {
namespace {

/// An arc that touches the axis may pass it by its rounding, as a share of the profile's size.
constexpr double kOnAxis = 1e-15;

class RevolutionKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    const Profile* const profile = primitive.profile();
    return profile != nullptr && profile->has_area() &&
           profile->min_x() >= -kOnAxis * profile->half().x;
  }

  bool has_same_solid(const Primitive& a, const Primitive& b) const override {
    return same_profile(a.profile(), b.profile());
  }
  bool has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const override {
    return same_profile(a.profile(), b.profile());
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    const std::shared_ptr<const Profile>& shared = primitive.as<RevolutionShape>().profile;
    const Profile& profile = *shared;
    CanonicalPrimitive result;
    result.enclosure = Shape::kFrustum;
    result.shared_shape = shared;
    const double radius = profile.center().x + profile.half().x;
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point({0, 0, profile.center().y});
    result.canonical_to_world =
        Mat3{linear[0] * radius, linear[1] * radius, linear[2] * profile.half().y};
    result.world_to_canonical = inverse(result.canonical_to_world);
    return result;
  }

  Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const override {
    const Profile& profile = *primitive.profile();
    const double lateral = std::hypot(direction.x, direction.y);
    const Vec2 furthest = profile.support({lateral * profile.radii().y, direction.z});
    const double radius = profile.radii().x + profile.radii().y * furthest.x;
    const Vec2 across = lateral > 0 ? Vec2{direction.x, direction.y} / lateral : Vec2{1, 0};
    return {radius * across.x, radius * across.y, furthest.y};
  }

  bool contains(const CanonicalPrimitive& primitive, const Vec3& p) const override {
    const Profile& profile = *primitive.profile();
    const double radius = std::hypot(p.x, p.y);
    return profile.contains({(radius - profile.radii().x) / profile.radii().y, p.z});
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    const Profile& profile = *primitive.profile();
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    const Vec3 half = cell.half_box();
    // The cell's distances from the axis: by its box, and across the plane in which its centre is.
    const Vec2 center(cell.center);
    const Vec2 gap = glm::max(glm::abs(center) - Vec2(half), Vec2(0.0));
    const double distance = glm::length(center);
    double reach = cell.slack, furthest = 0;
    if (distance > 0) {
      for (int i = 0; i < 3; ++i) {
        reach += std::abs(glm::dot(center / distance, Vec2(cell.half[i])));
      }
    } else {
      reach = half.x + half.y;
    }
    for (int corner = 0; corner < 8; ++corner) {
      furthest = std::max(furthest, glm::length(Vec2(cell.corner(corner))));
    }
    const double nearest = std::max({0.0, glm::length(gap), distance - reach});
    const auto place = [&](double radius) {
      return (radius - profile.radii().x) / profile.radii().y;
    };
    const Rectangle rectangle{{place(nearest - cell.slack), cell.center.z - half.z},
                              {place(furthest + cell.slack), cell.center.z + half.z}};
    return csgcore::classify(profile, rectangle, {place(furthest), cell.center.z}, place(0));
  }
};

constexpr RevolutionKind kRevolutionKind;

}  // namespace

constinit const PrimitiveKind& Revolution_kind = kRevolutionKind;

}  // namespace csgcore
