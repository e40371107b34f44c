// A test in float that finds points far away from a primitive. It decides most of a list's
// primitives at a fraction of the cost of their segments. Included once per instruction set.
#if defined(CSGCORE_APART_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_APART_INL_HPP
#undef CSGCORE_APART_INL_HPP
#else
#define CSGCORE_APART_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitives/frustum-inl.hpp"
#include "primitives/sphere-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// A point on a ray counts as outside of a primitive without an intersection if it lies this many
/// thickness tolerances away from it, which is far more than rounding. Then no crossing of that
/// primitive can coincide with one at the point, unless the ray runs along the face; coincidence
/// resolution handles that.
constexpr double kApart = 0x1p14;

/// Allowances for the rounding of float (NUMERICS.md, "Classification and culling"). A point must
/// be kApartAsked times the distance away. No answer is given if the point or the primitive is more
/// than kApartFurthest times the distance from the pivot, or if the distance in canonical space,
/// whose coordinates are about 1, is less than kApartLeastReach.
constexpr double kApartAsked = 2.0;
constexpr double kApartFurthest = 0x1p18;
constexpr double kApartLeastReach = 0x1p-18;

/// A packet of points, relative to the pivot; NaN for those that are too far away.
struct alignas(64) PacketPoints {
  float coordinate[3][kPacketRays];
};

/// Finds the rays' points at t.
HWY_NOINLINE static HWY_MAYBE_UNUSED void find_points(const RayPacket& rays, const PacketV& t,
                                                      double distance, PacketPoints& points) {
  const Wide d;
  const hn::Rebind<float, Wide> narrow;
  const WideV furthest = hn::Set(d, kApartFurthest * distance);
  const WideV none = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (int axis = 0; axis < 3; ++axis) {
    for (int c = 0; c < kChunks; ++c) {
      const size_t first = first_lane(c);
      const WideV direction = hn::Load(d, rays.direction[axis] + first);
      const WideV at =
          hn::Add(hn::Load(d, rays.origin[axis] + first), hn::Mul(direction, t.chunk[c]));
      const WideV told = hn::IfThenElse(hn::Le(hn::Abs(at), furthest), at, none);
      hn::Store(hn::DemoteTo(narrow, told), narrow, points.coordinate[axis] + first);
    }
  }
}

/// `center` is relative to the pivot, `reach` in canonical space.
template <Shape kEnclosure>
HWY_INLINE LaneMask lanes_apart_from(const CanonicalPrimitive& primitive, const Vec3& center,
                                     const PacketPoints& points, double reach) {
  const Floats d;
  const Lanes3<Floats> from = broadcast(d, center);
  LaneMask result = 0;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    const Lanes3<Floats> point = Lanes3<Floats>{hn::Load(d, points.coordinate[0] + first),
                                                hn::Load(d, points.coordinate[1] + first),
                                                hn::Load(d, points.coordinate[2] + first)} -
                                 from;
    const auto apart = kEnclosure == Shape::kSphere
                           ? sphere_rays::lies_apart(d, primitive, point, reach)
                           : frustum_rays::lies_apart(d, primitive, point, reach);
    result |= float_bits_of(apart, first);
  }
  return result;
}

/// Returns lanes whose points certainly lie further than `distance` away from the primitive (or
/// from a polyhedron's enclosure).
HWY_NOINLINE static HWY_MAYBE_UNUSED LaneMask lanes_apart(const CanonicalPrimitive& primitive,
                                                          const Vec3& pivot,
                                                          const PacketPoints& points,
                                                          double distance) {
  const Vec3 center = primitive.center - pivot;
  const double reach = kApartAsked * distance * primitive.canonical_stretch;
  const double furthest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  if (!(reach >= kApartLeastReach && furthest <= kApartFurthest * distance)) return 0;
  return primitive.enclosure == Shape::kSphere
             ? lanes_apart_from<Shape::kSphere>(primitive, center, points, reach)
             : lanes_apart_from<Shape::kFrustum>(primitive, center, points, reach);
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
