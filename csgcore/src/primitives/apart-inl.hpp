// Who stands far from a primitive, told in float: most of a list's primitives, at a fraction of
// what their segments cost. Included once per instruction set.
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

/// A ray that stands so many thinnest pieces away from a primitive is told to be outside by its
/// place alone: far more than what is rounded there. No crossing of that primitive can be together
/// with one where the ray stands, unless the ray runs along that face: the resolver's business.
constexpr double kApart = 0x1p14;

/// What float rounds (NUMERICS.md, "Classification and culling"): twice the distance is asked for,
/// and nothing is said of points and primitives so many times the distance from the pivot, or where
/// the distance is less in canonical space, whose coordinates are about 1.
constexpr double kApartAsked = 2.0;
constexpr double kApartFurthest = 0x1p18;
constexpr double kApartLeastReach = 0x1p-18;

/// As many lanes as the machine has, up to 16.
using Floats = hn::CappedTag<float, 16>;

/// Points of a packet, relative to the pivot; NaN for those too far away to be told.
struct alignas(64) PacketPoints {
  float coordinate[3][kPacketRays];
};

/// The rays' at t.
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

/// `center`: relative to the pivot; `reach`: in canonical space.
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
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, apart, bytes);
    result |= (LaneMask{bytes[0]} | LaneMask{bytes[1]} << 8) << first;
  }
  return result;
}

/// The lanes whose points lie further away from the primitive (of a polyhedron: from what encloses
/// it) than `distance`, as far as float tells.
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
