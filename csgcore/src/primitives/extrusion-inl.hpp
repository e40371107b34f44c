// The crossings of rays with extrusions. Included once per instruction set.
//
// An extrusion's cross-sections are one figure at different scales, so that a ray projects to a
// straight line in the figure's plane, along which it moves on. The line's crossings with the
// figure's loops cancel (profile_line.hpp). They divide the line into stretches within and without,
// and the ray is inside where it is on the former and between the caps. No decision is made twice,
// so that side faces and caps fit together on every ray.
#if defined(CSGCORE_EXTRUSION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_EXTRUSION_INL_HPP
#undef CSGCORE_EXTRUSION_INL_HPP
#else
#define CSGCORE_EXTRUSION_INL_HPP
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
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace extrusion_rays {

/// The face of both caps. Side faces have the number of their piece.
constexpr uint32_t kCap = 0xFFFFFFFFu;

/// The lines of a packet's rays in the figure's plane, in double and in float.
struct alignas(64) PacketLines {
  double direction[2][kPacketRays];
  double offset[kPacketRays];
  /// Where the rays enter and leave the part between the caps that may hold the solid, along the
  /// line and in t.
  double first[kPacketRays], last[kPacketRays];
  double first_t[kPacketRays], last_t[kPacketRays];
  // A ray is at along = foot + speed·t / (scale·(scale + growth·t)), for t relative to `base`.
  double base[kPacketRays], foot[kPacketRays], speed[kPacketRays], scale[kPacketRays];
  double growth[kPacketRays];
  /// What t is relative to.
  double origin_t[kPacketRays];
  float near_direction[2][kPacketRays];
  float near_offset[kPacketRays];
  float near_first[kPacketRays];
  float near_last[kPacketRays];

  ProfileLine line(size_t lane) const {
    return {{direction[0][lane], direction[1][lane]}, offset[lane]};
  }

  /// Returns t at a place on the line, from `first` to `last`.
  double t_at(size_t lane, double along) const {
    const double way = (along - foot[lane]) * scale[lane];
    const double t = base[lane] + way * scale[lane] / (speed[lane] - way * growth[lane]);
    return std::clamp(t, first_t[lane], last_t[lane]);
  }
};

/// The figure lies in the square [−1, 1]², and no line that is further than this from its middle
/// meets it.
constexpr double kFurthestLine = 1.4143;
/// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
constexpr double kEnclosure2 = 2.0001;

/// Projects the rays o + t·along of the vector of lanes that begins at `lane`, where the origins
/// are the points next to the canonical origin, and inverse_length2 = 1/along². Returns which of
/// them may meet the solid.
HWY_INLINE WideM project(const CanonicalPrimitive& primitive, const Lanes3<Wide>& o,
                         const Lanes3<Wide>& along, WideV inverse_length2, size_t lane,
                         PacketLines& rays) {
  const Wide d;
  const WideV zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const WideV beside2 = hn::Sub(hn::Set(d, kEnclosure2), dot(d, o, o));
  WideM meets = hn::Gt(beside2, zero);
  const WideV half_chord = hn::Sqrt(hn::Mul(beside2, inverse_length2));
  WideV first = hn::Neg(half_chord), last = half_chord;
  const WideV lateral2 = hn::Add(hn::Mul(along.x, along.x), hn::Mul(along.y, along.y));
  const WideV trace2 = hn::Set(d, frustum_rays::kTrace * frustum_rays::kTrace);
  const WideM is_level = hn::Le(hn::Mul(along.z, along.z), hn::Mul(trace2, lateral2));
  const WideV rise = hn::IfThenElse(hn::Gt(along.z, zero), one, hn::Neg(one));
  const WideV enter = hn::Div(hn::Sub(hn::Neg(rise), o.z), along.z);
  const WideV leave = hn::Div(hn::Sub(rise, o.z), along.z);
  const WideM enters_by_cap = hn::AndNot(is_level, hn::Gt(enter, first));
  const WideM leaves_by_cap = hn::AndNot(is_level, hn::Lt(leave, last));
  first = hn::IfThenElse(enters_by_cap, enter, first);
  last = hn::IfThenElse(leaves_by_cap, leave, last);
  meets = hn::AndNot(hn::And(is_level, hn::Gt(hn::Abs(o.z), one)), meets);
  meets = hn::And(meets, hn::Lt(first, last));
  // The figure's scale at a height, which is exact at the caps.
  const double unit = 1 / primitive.profile()->reach();
  const auto scale_at = [&](WideV t, WideM is_on_cap, WideV cap) {
    const WideV z = hn::IfThenElse(is_on_cap, cap, hn::Add(o.z, hn::Mul(t, along.z)));
    return hn::Mul(hn::Set(d, unit), hn::Add(hn::Set(d, primitive.radius_mid),
                                             hn::Mul(hn::Set(d, primitive.radius_slope), z)));
  };
  const WideV first_scale = scale_at(first, enters_by_cap, hn::Neg(rise));
  const WideV last_scale = scale_at(last, leaves_by_cap, rise);
  // About the point where the figure is largest, nothing cancels.
  const WideV growth =
      hn::IfThenZeroElse(is_level, hn::Mul(hn::Set(d, unit * primitive.radius_slope), along.z));
  const WideM is_even = hn::Eq(growth, zero);
  const WideV base = hn::IfThenZeroElse(is_even, hn::IfThenElse(hn::Gt(growth, zero), last, first));
  const WideV scale = hn::IfThenElse(is_even, first_scale, hn::Max(first_scale, last_scale));
  meets = hn::And(meets, hn::Gt(scale, zero));
  const WideV x = hn::Add(o.x, hn::Mul(base, along.x));
  const WideV y = hn::Add(o.y, hn::Mul(base, along.y));
  const WideV place_x = hn::Div(x, scale), place_y = hn::Div(y, scale);
  const WideV motion_x = hn::Sub(hn::Mul(scale, along.x), hn::Mul(growth, x));
  const WideV motion_y = hn::Sub(hn::Mul(scale, along.y), hn::Mul(growth, y));
  WideV speed = hn::Sqrt(hn::Add(hn::Mul(motion_x, motion_x), hn::Mul(motion_y, motion_y)));
  speed =
      hn::IfThenElseZero(hn::Gt(hn::Mul(hn::Mul(speed, speed), inverse_length2), trace2), speed);
  // A ray that stays at its place asks what is there, on any line through it.
  const WideM moves = hn::Gt(speed, zero);
  const WideV direction_x = hn::IfThenElse(moves, hn::Div(motion_x, speed), one);
  const WideV direction_y = hn::IfThenElseZero(moves, hn::Div(motion_y, speed));
  const WideV offset = hn::Sub(hn::Mul(direction_x, place_y), hn::Mul(direction_y, place_x));
  meets = hn::And(meets, hn::Le(hn::Abs(offset), hn::Set(d, kFurthestLine)));
  const WideV foot = hn::Add(hn::Mul(direction_x, place_x), hn::Mul(direction_y, place_y));
  const auto along_at = [&](WideV t, WideV scale_there) {
    const WideV way =
        hn::Div(hn::Mul(speed, hn::Sub(t, base)), hn::Mul(scale, hn::Max(scale_there, zero)));
    return hn::IfThenElse(moves, hn::Add(foot, way), foot);
  };
  const WideV first_along = along_at(first, first_scale), last_along = along_at(last, last_scale);
  const auto keep = [&](WideV value, double* all) { hn::Store(value, d, all + lane); };
  keep(direction_x, rays.direction[0]);
  keep(direction_y, rays.direction[1]);
  keep(offset, rays.offset);
  keep(first_along, rays.first);
  keep(last_along, rays.last);
  keep(first, rays.first_t);
  keep(last, rays.last_t);
  keep(base, rays.base);
  keep(foot, rays.foot);
  keep(speed, rays.speed);
  keep(scale, rays.scale);
  keep(growth, rays.growth);
  const hn::Rebind<float, Wide> near;
  const auto keep_near = [&](WideV value, float* all) {
    hn::Store(hn::DemoteTo(near, value), near, all + lane);
  };
  keep_near(direction_x, rays.near_direction[0]);
  keep_near(direction_y, rays.near_direction[1]);
  keep_near(offset, rays.near_offset);
  keep_near(first_along, rays.near_first);
  keep_near(last_along, rays.near_last);
  return meets;
}

/// Returns the rays that pass the box |x|, |y| ≤ lateral, |z| ≤ 1 in canonical space, and some
/// others that pass next to it.
HWY_INLINE WideM pass_box(const Lanes3<Wide>& origin, const Lanes3<Wide>& direction,
                          double lateral) {
  const Wide d;
  constexpr double kMargin = 1 + 1e-9;
  // A coordinate of 0 stands for one next to it.
  constexpr double kLeast = 1e-300;
  WideV enter = hn::Set(d, -kInfinity), leave = hn::Set(d, kInfinity);
  const auto cut = [&](WideV o, WideV along, double half) {
    const WideV inverse =
        hn::Div(hn::Set(d, 1.0), hn::CopySign(hn::Max(hn::Abs(along), hn::Set(d, kLeast)), along));
    const WideV middle = hn::Neg(hn::Mul(o, inverse));
    const WideV reach = hn::Abs(hn::Mul(hn::Set(d, half * kMargin), inverse));
    enter = hn::Max(enter, hn::Sub(middle, reach));
    leave = hn::Min(leave, hn::Add(middle, reach));
  };
  cut(origin.x, direction.x, lateral);
  cut(origin.y, direction.y, lateral);
  cut(origin.z, direction.z, 1);
  return hn::Le(enter, leave);
}

/// Projects the rays. Returns the lanes that may meet the solid.
HWY_INLINE LaneMask project_lanes(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                                  const CanonicalPrimitive& primitive, PacketLines& rays) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask reaching = 0;
  const double lateral =
      (primitive.radius_mid + std::abs(primitive.radius_slope)) / primitive.profile()->reach();
  for (const int c : ChunksOf(lanes)) {
    const size_t lane = first_lane(c);
    const auto [o, along, inverse_length2, origin_t] =
        polyhedron_rays::rebased(d, primitive, center, load_rays(d, packet, lane));
    const LaneMask passing = bits_of(pass_box(o, along, lateral), c) & lanes;
    if (passing == 0) continue;
    hn::Store(origin_t, d, rays.origin_t + lane);
    reaching |= bits_of(project(primitive, o, along, inverse_length2, lane, rays), c) & passing;
  }
  return reaching;
}

/// Lanes that pass a node's box, and those of them that do so only before they reach the solid's
/// height.
struct Passing {
  LaneMask through = 0, before = 0;
};

HWY_INLINE Passing lanes_through(const Profile::Node& node, const PacketLines& rays,
                                 LaneMask lanes) {
  const Floats d;
  const auto center_x = hn::Set(d, 0.5f * (node.min[0] + node.max[0]));
  const auto center_y = hn::Set(d, 0.5f * (node.min[1] + node.max[1]));
  const auto half_x = hn::Set(d, 0.5f * (node.max[0] - node.min[0]));
  const auto half_y = hn::Set(d, 0.5f * (node.max[1] - node.min[1]));
  Passing passing;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    if ((lanes & float_lanes(first)) == 0) continue;
    const auto x = hn::Load(d, rays.near_direction[0] + first);
    const auto y = hn::Load(d, rays.near_direction[1] + first);
    const auto height = hn::Sub(hn::Sub(hn::Mul(x, center_y), hn::Mul(y, center_x)),
                                hn::Load(d, rays.near_offset + first));
    const auto along = hn::Add(hn::Mul(x, center_x), hn::Mul(y, center_y));
    const auto across = hn::Add(hn::Mul(hn::Abs(x), half_y), hn::Mul(hn::Abs(y), half_x));
    const auto reach = hn::Add(hn::Mul(hn::Abs(x), half_x), hn::Mul(hn::Abs(y), half_y));
    const auto meets = hn::And(hn::Le(hn::Abs(height), across),
                               hn::Le(hn::Sub(along, reach), hn::Load(d, rays.near_last + first)));
    const auto before = hn::Lt(hn::Add(along, reach), hn::Load(d, rays.near_first + first));
    passing.through |= float_bits_of(meets, first);
    passing.before |= float_bits_of(before, first);
  }
  passing.through &= lanes;
  passing.before &= passing.through;
  return passing;
}

/// Returns the lanes whose lines may cross the piece.
HWY_INLINE LaneMask lanes_across(const Profile::Piece& piece, const PacketLines& rays,
                                 LaneMask lanes) {
  const Wide d;
  LaneMask across = 0;
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const WideV x = hn::Load(d, rays.direction[0] + first);
    const WideV y = hn::Load(d, rays.direction[1] + first);
    const WideV offset = hn::Load(d, rays.offset + first);
    const auto is_left = [&](const Vec2& p) {
      const WideV turn = hn::Sub(hn::Mul(x, hn::Set(d, p.y)), hn::Mul(y, hn::Set(d, p.x)));
      return hn::Ge(hn::Sub(turn, offset), hn::Zero(d));
    };
    const WideM from_left = is_left(piece.start);
    WideM differs = hn::Xor(from_left, is_left(piece.end));
    if (!piece.is_line()) differs = hn::Or(differs, hn::Xor(from_left, is_left(piece.control)));
    across |= bits_of(differs, c);
  }
  return across & lanes;
}

/// Adds the crossings of the lanes' lines with the figure's pieces, which have the place along the
/// line in place of t.
HWY_INLINE void cross_lines(const Profile& profile, const PacketLines& rays, LaneMask lanes,
                            CrossingSearch& search) {
  const auto pass = [&](const Profile::Node& node, LaneMask visiting) {
    const Passing passing = lanes_through(node, rays, visiting);
    // Whole loops that lie before the solid's height cancel, and of a chain only the ends count.
    if (node.is_chain) {
      for_each_lane(passing.before, [&](uint32_t lane) {
        const ProfileLine line = rays.line(lane);
        const int turn = ProfileLine::is_left(line.height(profile.pieces()[node.begin].start)) -
                         ProfileLine::is_left(line.height(profile.pieces()[node.end - 1].end));
        if (turn != 0) search.lanes[lane].found.push_back({-kInfinity, node.begin, turn});
      });
    }
    return passing.through & ~passing.before;
  };
  const auto cross = [&](const Profile::Node& node, LaneMask through) {
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Profile::Piece& piece = profile.pieces()[i];
      for_each_lane(lanes_across(piece, rays, through), [&](uint32_t lane) {
        for_each_crossing(rays.line(lane), piece, [&](double along, int turn) {
          search.lanes[lane].found.push_back({along, i, turn});
        });
      });
    }
  };
  walk_profile(profile, lanes, search.stack, pass, cross);
}

/// Replaces the crossings of a ray's line with the figure by those of the ray with the solid.
HWY_INLINE void cut_by_caps(const Profile& profile, const PacketLines& rays, size_t lane,
                            std::vector<Crossing>& found) {
  const double first = rays.first[lane], last = rays.last[lane], base = rays.origin_t[lane];
  // Only the sum of the turns before the solid's height matters, and nothing of those behind it. A
  // figure that crosses itself everywhere has most of its crossings there.
  int before = 0;
  std::erase_if(found, [&](const Crossing& crossing) {
    if (crossing.t < first) before += crossing.turn;
    return crossing.t < first || crossing.t > last;
  });
  if (before != 0) found.push_back({-kInfinity, 0, before});
  sort(found);
  int open = 0;
  for (const Crossing& crossing : found) open += crossing.turn;
  if (open != 0) found.push_back({kInfinity, 0, -open});
  size_t kept = 0;
  int winding = 0;
  Crossing start;
  const auto is_inside = [&] { return profile.is_inside(winding); };
  const auto end_at = [&](const Crossing& end) {
    if (!(end.t >= first) || !(start.t <= last)) return;
    const bool starts_on_cap = start.t <= first, ends_on_cap = end.t >= last;
    const double start_t = starts_on_cap ? rays.first_t[lane] : rays.t_at(lane, start.t);
    const double end_t = ends_on_cap ? rays.last_t[lane] : rays.t_at(lane, end.t);
    if (!(start_t < end_t)) return;
    found[kept] = {base + start_t, starts_on_cap ? kCap : start.face, 1};
    found[kept + 1] = {base + end_t, ends_on_cap ? kCap : end.face, -1};
    kept += 2;
  };
  for (size_t i = 0; i < found.size(); ++i) {
    const Crossing crossing = found[i];
    const bool was_inside = is_inside();
    winding += crossing.turn;
    if (is_inside() == was_inside) continue;
    if (was_inside) {
      end_at(crossing);
    } else {
      start = crossing;
    }
  }
  found.resize(kept);
}

}  // namespace extrusion_rays

/// See kind_crossings-inl.hpp.
struct ExtrusionCrossings {
  static constexpr bool kFindsAll = true;

  static void find(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                   const CanonicalPrimitive& primitive, CrossingSearch& search) {
    const Profile& profile = *primitive.profile();
    extrusion_rays::PacketLines rays;
    const LaneMask reaching = extrusion_rays::project_lanes(frame, packet, lanes, primitive, rays);
    if (reaching == 0) return;
    extrusion_rays::cross_lines(profile, rays, reaching, search);
    for (LaneMask left = reaching; left != 0; left &= left - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(left));
      extrusion_rays::cut_by_caps(profile, rays, lane, search.lanes[lane].found);
    }
  }

  static bool is_closed(const CanonicalPrimitive&) { return true; }

  static Vec3 normal(const CanonicalPrimitive& primitive, uint32_t face, const Vec3& point) {
    const Profile& profile = *primitive.profile();
    if (face == extrusion_rays::kCap) return Vec3(0, 0, 1) * primitive.world_to_canonical;
    const Profile::Piece& piece = profile.pieces()[face];
    const double slope = primitive.radius_slope / profile.reach();
    const double scale = primitive.radius_mid / profile.reach() + slope * point.z;
    const Vec2 place =
        piece.is_line() || !(scale > 0) ? piece.start : Vec2{point.x / scale, point.y / scale};
    const Vec2 across = piece_normal(piece, place);
    // The plane that touches the surface there passes through the apex.
    const Vec3 normal{across.x, across.y, -slope * glm::dot(across, place)};
    return normal * primitive.world_to_canonical;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
