// The paths of rays through the half plane that holds a revolved profile, in canonical coordinates:
// r is the distance from the axis, z the height. Included once per instruction set.
//
// A ray passes the axis at a distance, its offset b. In the plane through it that runs along the
// axis, where a point has the places ρ and z with r² = b² + ρ², it is the straight line (ρ, z) =
// (start + τ·run, height + τ·rise). In the half plane it is a branch of a hyperbola, or, where it
// is level, a straight line that is passed towards the axis and back, and counts as a hyperbola
// that is thinner than any number.
//
// A vertex lies within this path, where r is larger, or else without; this is decided by the same
// operations for both pieces that share it. A piece whose ends lie on different sides is crossed an
// odd number of times, and another one an even number. So the crossings of a loop cancel.
#if defined(CSGCORE_REVOLUTION_PATH_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_REVOLUTION_PATH_INL_HPP
#undef CSGCORE_REVOLUTION_PATH_INL_HPP
#else
#define CSGCORE_REVOLUTION_PATH_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "csgcore/profile.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace revolution_rays {

/// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
constexpr double kEnclosure2 = 2.0001;
/// The height within which it lies, and a little more, so that no rounding cuts it.
constexpr double kEnclosureHeight = 1 + 1e-9;
/// A ray is level, or runs along the axis, if its direction has less than this share along it, or
/// across it. Within the solid it does not drift by a bit of its coordinates.
constexpr double kTrace = 1e-30;
/// A height of 0 counts as one that is less than any other: simulation of simplicity.
constexpr double kNoHeight = 1e-200;

/// A vector of paths.
struct PathV {
  WideV offset;          // b ≥ 0
  WideV start;           // ρ at τ = 0
  WideV height;          // z at τ = 0
  WideV run, rise;       // run² + rise² = 1, run ≥ 0; rise is 0 if the ray is level
  WideV rise2;           // rise²
  WideV run_at_height;   // rise·start
  WideV first, last;     // τ where it enters and leaves the part that may hold the solid
  WideV base, unit;      // t = base + unit·τ
  WideM starts_nearest;  // the ray is nearest to the axis at τ = 0; else it is not in the solid
  WideM is_downwards;    // else the path runs upwards or is level
};

/// The paths of a packet's rays, and in float what tests of all of them need.
struct alignas(64) PacketPaths {
  PathV chunk[kChunks];
  float near_offset2[kPacketRays];
  float near_start[kPacketRays];
  float near_height[kPacketRays];
  float near_run[kPacketRays];
  float near_inverse[kPacketRays];  // of the rise
  float near_first[kPacketRays];
  float near_last[kPacketRays];
};

/// A point of the half plane as paths see it.
struct PointV {
  WideV r;
  WideV height;  // above the path's at τ = 0
  WideV run;     // rise·ρ, for the ray's point at this height
};

/// Returns the distance from the axis at a canonical place of the profile.
HWY_INLINE double radius_at(const Profile& profile, double x) {
  return std::max(0.0, profile.radii().x + profile.radii().y * x);
}

HWY_INLINE PointV seen(const PathV& path, const Profile& profile, const Vec2& place) {
  const Wide d;
  WideV height = hn::Set(d, place.y) - path.height;
  height = hn::IfThenElse(hn::Eq(height, hn::Zero(d)), hn::Set(d, kNoHeight), height);
  return {hn::Set(d, radius_at(profile, place.x)), height, path.run_at_height + height * path.run};
}

/// The polar form of the function that is > 0 within the path.
HWY_INLINE WideV within(const PathV& path, const PointV& a, const PointV& b) {
  return path.rise2 * (a.r * b.r - path.offset * path.offset) - a.run * b.run;
}
HWY_INLINE WideM is_within(const PathV& path, const PointV& p) {
  const WideV beside = (p.r - path.offset) * (p.r + path.offset);
  return hn::Gt(path.rise2 * beside - p.run * p.run, hn::Zero(Wide()));
}

/// Finds the paths of the rays, whose origins are the points next to the canonical origin. Returns
/// which of them may meet the solid.
HWY_INLINE WideM find_path(const polyhedron_rays::RebasedRays<Wide>& rays, PathV& path) {
  const Wide d;
  const WideV zero = hn::Zero(d), one = hn::Set(d, 1.0), trace = hn::Set(d, kTrace);
  const Lanes3<Wide>& o = rays.o;
  const WideV beside2 = hn::Set(d, kEnclosure2) - dot(d, o, o);
  path.unit = hn::Sqrt(rays.inverse_length2);
  const Lanes3<Wide> along = scaled(rays.direction, path.unit);
  path.run = hn::Sqrt(along.x * along.x + along.y * along.y);
  path.run = hn::IfThenElseZero(hn::Gt(path.run, trace), path.run);
  path.rise = hn::IfThenElseZero(hn::Gt(hn::Abs(along.z), trace), along.z);
  path.is_downwards = hn::Lt(path.rise, zero);
  const WideM is_level = hn::Eq(path.rise, zero), is_upright = hn::Eq(path.run, zero);
  const WideV height = hn::Set(d, kEnclosureHeight);
  const WideV end = hn::IfThenElse(path.is_downwards, hn::Neg(height), height);
  const WideV half_chord = hn::Sqrt(beside2);
  WideV first = hn::Neg(half_chord), last = half_chord;  // from the origin, per unit of length
  first = hn::IfThenElse(is_level, first, hn::Max(first, (hn::Neg(end) - o.z) / path.rise));
  last = hn::IfThenElse(is_level, last, hn::Min(last, (end - o.z) / path.rise));
  const WideV nearest = hn::Neg(o.x * along.x + o.y * along.y) / (path.run * path.run);
  const WideV base = hn::IfThenZeroElse(is_upright, hn::Max(first, hn::Min(last, nearest)));
  path.starts_nearest = hn::AndNot(is_upright, hn::Eq(base, nearest));
  const Lanes3<Wide> start = o + scaled(along, base);
  const WideV ahead_x = hn::IfThenElse(is_upright, one, along.x / path.run);
  const WideV ahead_y = hn::IfThenZeroElse(is_upright, along.y / path.run);
  path.start = start.x * ahead_x + start.y * ahead_y;
  path.offset = hn::Abs(start.x * ahead_y - start.y * ahead_x);
  path.height = start.z;
  path.first = first - base;
  path.last = last - base;
  path.base = rays.base + base * path.unit;
  path.rise2 = path.rise * path.rise;
  path.run_at_height = path.rise * path.start;
  const WideM misses = hn::And(is_level, hn::Gt(hn::Abs(o.z), one));
  const WideM meets = hn::And(hn::Gt(beside2, zero), hn::Lt(first, last));
  return hn::AndNot(misses, hn::And(meets, hn::Le(path.offset, one)));
}

/// Finds the paths. Returns the lanes that may meet the solid.
HWY_INLINE LaneMask find_paths(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                               const CanonicalPrimitive& primitive, PacketPaths& paths) {
  const Wide d;
  const hn::Rebind<float, Wide> near;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask reaching = 0;
  for (const int c : ChunksOf(lanes)) {
    const size_t lane = first_lane(c);
    PathV& path = paths.chunk[c];
    const WideM meets =
        find_path(polyhedron_rays::rebased(d, primitive, center, load_rays(d, packet, lane)), path);
    reaching |= bits_of(meets, c);
    const auto keep_near = [&](WideV value, float* all, float margin = 0) {
      hn::Store(hn::Add(hn::DemoteTo(near, value), hn::Set(near, margin)), near, all + lane);
    };
    keep_near(path.offset * path.offset, paths.near_offset2);
    keep_near(path.start, paths.near_start);
    keep_near(path.height, paths.near_height);
    keep_near(path.run, paths.near_run);
    hn::Store(bounded_inverse(near, hn::DemoteTo(near, path.rise)), near,
              paths.near_inverse + lane);
    keep_near(path.first, paths.near_first, -Profile::kBoxMargin);
    keep_near(path.last, paths.near_last, Profile::kBoxMargin);
  }
  return reaching & lanes;
}

}  // namespace revolution_rays
}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
