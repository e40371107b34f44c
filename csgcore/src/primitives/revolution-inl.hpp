// The crossings of rays with revolutions. Included once per instruction set.
//
// revolution_piece.hpp decides what a ray crosses, and where. This file finds the pieces of the
// profile for which it has to be asked.
#if defined(CSGCORE_REVOLUTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_REVOLUTION_INL_HPP
#undef CSGCORE_REVOLUTION_INL_HPP
#else
#define CSGCORE_REVOLUTION_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "primitives/profile_line.hpp"
#include "primitives/profile_walk.hpp"
#include "primitives/revolution_path.hpp"
#include "primitives/revolution_piece.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace revolution_rays {

/// The paths of a packet's rays, and what tests of all of them need, in double and in float.
struct alignas(64) PacketPaths {
  RevolutionPath paths[kPacketRays];
  double rise2[kPacketRays];
  double offset[kPacketRays];
  double offset2[kPacketRays];
  double height[kPacketRays];
  double run[kPacketRays];
  double run_at_height[kPacketRays];  // rise·start
  float near_offset2[kPacketRays];
  float near_start[kPacketRays];
  float near_height[kPacketRays];
  float near_run[kPacketRays];
  float near_inverse[kPacketRays];  // of the rise
  float near_first[kPacketRays];
  float near_last[kPacketRays];
};

/// Finds the paths. Returns the lanes that may meet the solid.
HWY_INLINE LaneMask find_paths(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                               const CanonicalPrimitive& primitive, PacketPaths& paths) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask reaching = 0;
  alignas(64) double origin[3][kLanes], direction[3][kLanes], inverse_length2[kLanes], base[kLanes];
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const auto [o, along, inverse, at] =
        polyhedron_rays::rebased(d, primitive, center, load_rays(d, packet, first));
    const WideV os[] = {o.x, o.y, o.z}, alongs[] = {along.x, along.y, along.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      hn::Store(os[axis], d, origin[axis]);
      hn::Store(alongs[axis], d, direction[axis]);
    }
    hn::Store(inverse, d, inverse_length2);
    hn::Store(at, d, base);
    for (LaneMask left = lanes & chunk_lanes(c); left != 0; left &= left - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(left));
      const size_t i = lane - first;
      RevolutionPath& path = paths.paths[lane];
      if (!find_path({origin[0][i], origin[1][i], origin[2][i]},
                     {direction[0][i], direction[1][i], direction[2][i]}, inverse_length2[i],
                     path)) {
        continue;
      }
      path.base += base[i];
      reaching |= LaneMask{1} << lane;
      paths.rise2[lane] = path.rise * path.rise;
      paths.offset[lane] = path.offset;
      paths.offset2[lane] = path.offset * path.offset;
      paths.height[lane] = path.height;
      paths.run[lane] = path.run;
      paths.run_at_height[lane] = path.rise * path.start;
      paths.near_offset2[lane] = static_cast<float>(path.offset * path.offset);
      paths.near_start[lane] = static_cast<float>(path.start);
      paths.near_height[lane] = static_cast<float>(path.height);
      paths.near_run[lane] = static_cast<float>(path.run);
      const hn::CappedTag<double, 1> one;
      paths.near_inverse[lane] =
          static_cast<float>(hn::GetLane(bounded_inverse(one, hn::Set(one, path.rise))));
      paths.near_first[lane] = static_cast<float>(path.first) - Profile::kBoxMargin;
      paths.near_last[lane] = static_cast<float>(path.last) + Profile::kBoxMargin;
    }
  }
  return reaching;
}

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

/// Returns the lanes whose paths may cross the piece: those for which not all coefficients of the
/// Bernstein form of its distance from the path have one sign.
HWY_INLINE LaneMask lanes_across(const Profile& profile, const Profile::Piece& piece,
                                 const PacketPaths& paths, LaneMask lanes) {
  const Wide d;
  LaneMask across = 0;
  struct Point {
    WideV r, height, run;
  };
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const WideV rise2 = hn::Load(d, paths.rise2 + first);
    const WideV offset = hn::Load(d, paths.offset + first);
    const WideV offset2 = hn::Load(d, paths.offset2 + first);
    const auto seen = [&](const Vec2& place) {
      WideV height = hn::Sub(hn::Set(d, place.y), hn::Load(d, paths.height + first));
      height = hn::IfThenElse(hn::Eq(height, hn::Zero(d)), hn::Set(d, kNoHeight), height);
      const WideV run = hn::Add(hn::Load(d, paths.run_at_height + first),
                                hn::Mul(height, hn::Load(d, paths.run + first)));
      return Point{hn::Set(d, radius_at(profile, place.x)), height, run};
    };
    const auto within = [&](const Point& a, const Point& b) {
      const WideV beside = hn::Sub(hn::Mul(a.r, b.r), offset2);
      return hn::Sub(hn::Mul(rise2, beside), hn::Mul(a.run, b.run));
    };
    const auto is_positive = [&](WideV v) { return hn::Gt(v, hn::Zero(d)); };
    // These are the operations of revolution_piece.cpp, so that the answer is the same.
    const auto is_within = [&](const Point& p) {
      const WideV beside = hn::Mul(hn::Sub(p.r, offset), hn::Add(p.r, offset));
      return is_positive(hn::Sub(hn::Mul(rise2, beside), hn::Mul(p.run, p.run)));
    };
    const Point start = seen(piece.start), end = seen(piece.end);
    const WideM from_within = is_within(start);
    WideM differs = hn::Xor(from_within, is_within(end));
    if (piece.is_line()) {
      differs = hn::Or(differs, hn::AndNot(from_within, is_positive(within(start, end))));
    } else {
      const Point control = seen(piece.control);
      const WideV turns = hn::Set(d, 2 * piece.weight * piece.weight);
      const WideV middle = hn::Add(hn::Mul(turns, within(control, control)), within(start, end));
      for (const WideV value : {within(start, control), middle, within(control, end)}) {
        differs = hn::Or(differs, hn::Xor(from_within, is_positive(value)));
      }
      // The two halves of the path may be too near to each other for this to tell.
      const WideM start_below = hn::Lt(start.height, hn::Zero(d));
      differs = hn::Or(differs, hn::Xor(start_below, hn::Lt(end.height, hn::Zero(d))));
    }
    across |= bits_of(differs, c);
  }
  return across & lanes;
}

HWY_INLINE void cross_paths(const Profile& profile, const PacketPaths& paths, LaneMask lanes,
                            CrossingSearch& search) {
  walk_profile(
      profile, lanes, search.stack,
      [&](const Profile::Node& node, LaneMask visiting) {
        return lanes_through(profile, node, paths, visiting);
      },
      [&](const Profile::Piece& piece, LaneMask through) {
        return lanes_across(profile, piece, paths, through);
      },
      [&](uint32_t lane, const Profile::Piece& piece, uint32_t i) {
        cross_piece(profile, paths.paths[lane], piece, i, search.lanes[lane].found);
      });
}

/// Leaves those of the crossings at which the ray enters or leaves the solid.
HWY_INLINE void keep_boundaries(const Profile& profile, std::vector<Crossing>& found) {
  std::sort(found.begin(), found.end());
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
    for (LaneMask left = reaching; left != 0; left &= left - 1) {
      revolution_rays::keep_boundaries(profile, search.lanes[std::countr_zero(left)].found);
    }
  }

  static bool is_closed(const CanonicalPrimitive&) { return true; }

  static Vec3 normal(const CanonicalPrimitive& primitive, uint32_t face, const Vec3& point) {
    const Profile& profile = *primitive.profile();
    const Vec2& radii = profile.radii();
    const double radius = std::hypot(point.x, point.y);
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
