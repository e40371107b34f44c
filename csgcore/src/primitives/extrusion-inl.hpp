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

/// The line of a ray in the figure's plane.
struct RayLine {
  ProfileLine line;
  /// Where the ray enters and leaves the part between the caps that may hold the solid, along the
  /// line and in t.
  double first, last;
  double first_t, last_t;
  // The ray is at along = foot + speed·t / (scale·(scale + growth·t)), for t relative to `base`.
  double base, foot, speed, scale, growth;

  /// Returns t at a place on the line, from `first` to `last`.
  double t_at(double along) const {
    const double way = (along - foot) * scale;
    const double t = base + way * scale / (speed - way * growth);
    return std::clamp(t, first_t, last_t);
  }
};

/// The lines of a packet's rays, in double and in float.
struct alignas(64) PacketLines {
  RayLine lines[kPacketRays];
  double direction[2][kPacketRays];
  double offset[kPacketRays];
  float near_direction[2][kPacketRays];
  float near_offset[kPacketRays];
  float near_first[kPacketRays];
  float near_last[kPacketRays];
};

/// The figure lies in the square [−1, 1]², and no line that is further than this from its middle
/// meets it.
constexpr double kFurthestLine = 1.4143;
/// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
constexpr double kEnclosure2 = 2.0001;

/// Projects the ray origin + t·direction, where the origin is the point next to the canonical
/// origin, and inverse_length2 = 1/direction². Returns false if it misses the solid.
HWY_INLINE bool project(const CanonicalPrimitive& primitive, const Vec3& origin,
                        const Vec3& direction, double inverse_length2, RayLine& ray) {
  const double beside2 = kEnclosure2 - glm::dot(origin, origin);
  if (!(beside2 > 0)) return false;
  const double half_chord = std::sqrt(beside2 * inverse_length2);
  double first = -half_chord, last = half_chord;
  const double lateral2 = direction.x * direction.x + direction.y * direction.y;
  constexpr double kTrace2 = frustum_rays::kTrace * frustum_rays::kTrace;
  const bool is_level = direction.z * direction.z <= kTrace2 * lateral2;
  double first_end = 0, last_end = 0;  // −1 or 1 where the ray passes that cap
  if (!is_level) {
    const double rise = direction.z > 0 ? 1 : -1;
    const double enter = (-rise - origin.z) / direction.z, leave = (rise - origin.z) / direction.z;
    if (enter > first) first = enter, first_end = -rise;
    if (leave < last) last = leave, last_end = rise;
  } else if (std::abs(origin.z) > 1) {
    return false;
  }
  if (!(first < last)) return false;
  // The figure's scale at a height, which is exact at the caps.
  const double unit = 1 / primitive.profile()->reach();
  const auto scale_at = [&](double z, double end) {
    return unit * (primitive.radius_mid + primitive.radius_slope * (end != 0 ? end : z));
  };
  const double first_scale = scale_at(origin.z + first * direction.z, first_end);
  const double last_scale = scale_at(origin.z + last * direction.z, last_end);
  // About the point where the figure is largest, nothing cancels.
  ray.growth =
      primitive.radius_slope == 0 || is_level ? 0 : unit * primitive.radius_slope * direction.z;
  ray.base = ray.growth == 0 ? 0 : ray.growth > 0 ? last : first;
  ray.scale = ray.growth == 0 ? first_scale : std::max(first_scale, last_scale);
  if (!(ray.scale > 0)) return false;
  const Vec2 at{origin.x + ray.base * direction.x, origin.y + ray.base * direction.y};
  const Vec2 place = at / ray.scale;
  const Vec2 motion = ray.scale * Vec2{direction.x, direction.y} - ray.growth * at;
  ray.speed = std::sqrt(glm::dot(motion, motion));
  if (!(ray.speed * ray.speed * inverse_length2 > kTrace2)) ray.speed = 0;
  // A ray that stays at its place asks what is there, on any line through it.
  ray.line.direction = ray.speed > 0 ? motion / ray.speed : Vec2{1, 0};
  ray.line.offset = cross(ray.line.direction, place);
  if (!(std::abs(ray.line.offset) <= kFurthestLine)) return false;
  ray.foot = ray.line.along(place);
  const auto along_at = [&](double t, double scale) {
    return ray.speed > 0 ? ray.foot + ray.speed * (t - ray.base) / (ray.scale * scale) : ray.foot;
  };
  ray.first = along_at(first, std::max(first_scale, 0.0));
  ray.last = along_at(last, std::max(last_scale, 0.0));
  ray.first_t = first;
  ray.last_t = last;
  return true;
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

/// Projects the rays. Returns the lanes that may meet the solid. `base` is what their t is relative
/// to.
HWY_INLINE LaneMask project_lanes(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                                  const CanonicalPrimitive& primitive, PacketLines& rays,
                                  double (&base)[kPacketRays]) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask reaching = 0;
  const double lateral =
      (primitive.radius_mid + std::abs(primitive.radius_slope)) / primitive.profile()->reach();
  alignas(64) double origin[3][kLanes], direction[3][kLanes], inverse_length2[kLanes];
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const auto [o, along, inverse, at] =
        polyhedron_rays::rebased(d, primitive, center, load_rays(d, packet, first));
    const LaneMask passing = bits_of(pass_box(o, along, lateral), c) & lanes;
    if (passing == 0) continue;
    const WideV os[] = {o.x, o.y, o.z}, alongs[] = {along.x, along.y, along.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      hn::Store(os[axis], d, origin[axis]);
      hn::Store(alongs[axis], d, direction[axis]);
    }
    hn::Store(inverse, d, inverse_length2);
    hn::Store(at, d, base + first);
    for (LaneMask left = passing; left != 0; left &= left - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(left));
      const size_t i = lane - first;
      RayLine& ray = rays.lines[lane];
      if (!project(primitive, {origin[0][i], origin[1][i], origin[2][i]},
                   {direction[0][i], direction[1][i], direction[2][i]}, inverse_length2[i], ray)) {
        continue;
      }
      reaching |= LaneMask{1} << lane;
      rays.direction[0][lane] = ray.line.direction.x;
      rays.direction[1][lane] = ray.line.direction.y;
      rays.offset[lane] = ray.line.offset;
      rays.near_direction[0][lane] = static_cast<float>(ray.line.direction.x);
      rays.near_direction[1][lane] = static_cast<float>(ray.line.direction.y);
      rays.near_offset[lane] = static_cast<float>(ray.line.offset);
      rays.near_first[lane] = static_cast<float>(ray.first);
      rays.near_last[lane] = static_cast<float>(ray.last);
    }
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
        const ProfileLine& line = rays.lines[lane].line;
        const int turn = ProfileLine::is_left(line.height(profile.pieces()[node.begin].start)) -
                         ProfileLine::is_left(line.height(profile.pieces()[node.end - 1].end));
        if (turn != 0) search.lanes[lane].found.push_back({-kInfinity, node.begin, turn});
      });
    }
    return passing.through & ~passing.before;
  };
  walk_profile(
      profile, lanes, search.stack, pass,
      [&](const Profile::Piece& piece, LaneMask through) {
        return lanes_across(piece, rays, through);
      },
      [&](uint32_t lane, const Profile::Piece& piece, uint32_t i) {
        for_each_crossing(rays.lines[lane].line, piece, [&](double along, int turn) {
          search.lanes[lane].found.push_back({along, i, turn});
        });
      });
}

/// Replaces the crossings of a ray's line with the figure by those of the ray with the solid.
HWY_INLINE void cut_by_caps(const Profile& profile, const RayLine& ray, double base,
                            std::vector<Crossing>& found) {
  // Only the sum of the turns before the solid's height matters, and nothing of those behind it. A
  // figure that crosses itself everywhere has most of its crossings there.
  int before = 0;
  std::erase_if(found, [&](const Crossing& crossing) {
    if (crossing.t < ray.first) before += crossing.turn;
    return crossing.t < ray.first || crossing.t > ray.last;
  });
  if (before != 0) found.push_back({-kInfinity, 0, before});
  std::sort(found.begin(), found.end());
  int open = 0;
  for (const Crossing& crossing : found) open += crossing.turn;
  if (open != 0) found.push_back({kInfinity, 0, -open});
  size_t kept = 0;
  int winding = 0;
  Crossing start;
  const auto is_inside = [&] { return profile.is_inside(winding); };
  const auto end_at = [&](const Crossing& end) {
    if (!(end.t >= ray.first) || !(start.t <= ray.last)) return;
    const bool starts_on_cap = start.t <= ray.first, ends_on_cap = end.t >= ray.last;
    const double start_t = starts_on_cap ? ray.first_t : ray.t_at(start.t);
    const double end_t = ends_on_cap ? ray.last_t : ray.t_at(end.t);
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
    alignas(64) double base[kPacketRays];
    const LaneMask reaching =
        extrusion_rays::project_lanes(frame, packet, lanes, primitive, rays, base);
    if (reaching == 0) return;
    extrusion_rays::cross_lines(profile, rays, reaching, search);
    for (LaneMask left = reaching; left != 0; left &= left - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(left));
      extrusion_rays::cut_by_caps(profile, rays.lines[lane], base[lane], search.lanes[lane].found);
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
