// The crossings of rays with revolutions. Included once per instruction set.
//
// revolution_piece-inl.hpp decides what a ray crosses, and where. This file finds the pieces of the
// profile for which it has to be asked.
#if defined(CSGCORE_REVOLUTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_REVOLUTION_INL_HPP
#undef CSGCORE_REVOLUTION_INL_HPP
#else
#define CSGCORE_REVOLUTION_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"
#include "primitives/profile_line.hpp"
#include "primitives/profile_walk.hpp"
#include "primitives/revolution_piece-inl.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace revolution_rays {

/// Returns the lanes whose paths pass a node's box.
HWY_INLINE LaneMask lanes_through(const Profile& profile, const Profile::Node& node,
                                  const PacketPaths& paths, LaneMask lanes) {
  const Floats d;
  const auto bottom = hn::Set(d, node.min[1]), top = hn::Set(d, node.max[1]);
  const auto radius = [&](float x) {
    return static_cast<float>(profile.radii().x + profile.radii().y * double{x});
  };
  const float inner = std::max(0.0f, radius(node.min[0]) - Profile::kBoxMargin);
  const float outer = radius(node.max[0]) + Profile::kBoxMargin;
  const auto inner2 = hn::Set(d, inner * inner), outer2 = hn::Set(d, outer * outer);
  LaneMask through = 0;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    if ((lanes & float_lanes(first)) == 0) continue;
    const auto height = hn::Load(d, paths.near_height + first);
    const auto inverse = hn::Load(d, paths.near_inverse + first);
    const auto a = hn::Mul(hn::Sub(bottom, height), inverse);
    const auto b = hn::Mul(hn::Sub(top, height), inverse);
    const auto enter = hn::Max(hn::Min(a, b), hn::Load(d, paths.near_first + first));
    const auto leave = hn::Min(hn::Max(a, b), hn::Load(d, paths.near_last + first));
    const auto start = hn::Load(d, paths.near_start + first);
    const auto run = hn::Load(d, paths.near_run + first);
    const auto from = hn::Add(start, hn::Mul(enter, run));
    const auto to = hn::Add(start, hn::Mul(leave, run));
    const auto offset2 = hn::Load(d, paths.near_offset2 + first);
    // Somewhere in the box's height, ρ is as near to 0 as it can be between its ends.
    const auto nearest = hn::Max(hn::Max(from, hn::Neg(to)), hn::Zero(d));
    const auto furthest = hn::Max(hn::Abs(from), hn::Abs(to));
    const auto meets =
        hn::And(hn::Le(enter, leave),
                hn::And(hn::Le(hn::Add(offset2, hn::Mul(nearest, nearest)), outer2),
                        hn::Ge(hn::Add(offset2, hn::Mul(furthest, furthest)), inner2)));
    through |= float_bits_of(meets, first);
  }
  return through & lanes;
}

HWY_INLINE void cross_paths(const Profile& profile, const PacketPaths& paths, LaneMask lanes,
                            CrossingSearch& search) {
  walk_profile(
      profile, lanes, search.stack,
      [&](const Profile::Node& node, LaneMask visiting) {
        return lanes_through(profile, node, paths, visiting);
      },
      [&](const Profile::Node& node, LaneMask through) {
        cross_pieces(profile, paths, node.begin, node.end, through, search);
      });
}

/// Leaves those of the crossings at which the ray enters or leaves the solid.
HWY_INLINE void keep_boundaries(const Profile& profile, std::vector<Crossing>& found) {
  sort(found);
  size_t kept = 0;
  int winding = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    const bool was_inside = profile.is_inside(winding);
    winding += found[i].turn;
    if (profile.is_inside(winding) == was_inside) continue;
    found[kept] = {found[i].t, found[i].face, was_inside ? -1 : 1};
    ++kept;
  }
  found.resize(kept);
}

}  // namespace revolution_rays

/// See kind_crossings-inl.hpp.
struct RevolutionCrossings {
  static constexpr bool kFindsAll = true;

  static void find(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                   const CanonicalPrimitive& primitive, CrossingSearch& search) {
    const Profile& profile = *primitive.profile();
    revolution_rays::PacketPaths paths;
    const LaneMask reaching = revolution_rays::find_paths(frame, packet, lanes, primitive, paths);
    if (reaching == 0) return;
    revolution_rays::cross_paths(profile, paths, reaching, search);
    for_each_lane(reaching, [&](uint32_t lane) {
      revolution_rays::keep_boundaries(profile, search.lanes[lane].found);
    });
  }

  static bool is_closed(const CanonicalPrimitive&) { return true; }

  static Vec3 normal(const CanonicalPrimitive& primitive, uint32_t face, const Vec3& point) {
    const Profile& profile = *primitive.profile();
    const Vec2& radii = profile.radii();
    const double radius = std::sqrt(point.x * point.x + point.y * point.y);
    const Vec2 across =
        piece_normal(profile.pieces()[face], {(radius - radii.x) / radii.y, point.z});
    // At an apex, the axis stands in.
    const double along = radii.y * radius * across.y;
    const Vec3 normal{across.x * point.x, across.x * point.y, along};
    return (normal == Vec3(0.0) ? Vec3(0, 0, 1) : normal) * primitive.world_to_canonical;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
