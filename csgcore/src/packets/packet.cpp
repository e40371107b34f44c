// Compiled once per instruction set by Highway. Multiplications and additions are never fused, and
// the result of a lane does not depend on other lanes: every instruction set gives the same bits.
#include "packets/packet.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/simd.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "packets/packet.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "packets/coincidences-inl.hpp"
#include "packets/resolve-inl.hpp"
#include "packets/walk-inl.hpp"
#include "primitives/primitive-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// Returns the factor that makes the primitive's normals those of the solid (paper §3.2, step 4).
HWY_INLINE WideV outward_sign(const TraceList& list, uint32_t index) {
  return hn::Set(Wide(), is_complement(list, index) ? -1.0 : 1.0);
}

/// The crossings at the lanes' t.
struct Crossings {
  Lanes3<Wide> normal[kChunks];
  PacketV facing;    // n·d|, the thickness per unit of t
  LaneMask unclear;  // lanes without a crossing at t, or whose crossing may coincide
};

/// Moves the windows of a primitive that is not convex to its crossings at t. Lowers `gap` to the
/// distance of the nearest crossing outside of the windows.
HWY_NOINLINE static HWY_MAYBE_UNUSED void aim_at_crossings(ListSegments& segments, uint32_t index,
                                                           LaneMask lanes, const PacketV& t,
                                                           PacketV& gap) {
  double at[kPacketRays];
  for (int c = 0; c < kChunks; ++c) hn::StoreU(t.chunk[c], Wide(), at + first_lane(c));
  segments.find_near(
      index, lanes, t, t, [&](uint32_t lane, double crossing) { return crossing == at[lane]; },
      gap);
}

/// Finds the crossings at the lanes' t, and stores their index, normal and on_cap in `hits`.
HWY_INLINE Crossings show_crossings(const RayPacket& rays, const TraceList& trace,
                                    const TraceParameters& parameters, ListSegments& segments,
                                    const Walk& walk, LaneMask lanes, PacketHits& hits) {
  const Wide d;
  Crossings result;
  PacketV gap;  // in t, to the nearest other crossing
  for (int c = 0; c < kChunks; ++c) {
    gap.chunk[c] = hn::Set(d, kInfinity);
    result.normal[c] = broadcast(d, Vec3{0.0});
  }
  LaneMask found = 0;
  LaneMask several = 0;
  bool any_apart = false;
  const double furthest_t = furthest_of(walk.t, lanes);
  const uint32_t count = trace.list->count();
  for (uint32_t index = 0; index < count; ++index) {
    LaneMask reached = lanes & segments.reached(index);
    if (reached == 0) continue;
    if (!segments.are_known(index, reached)) {
      const double nearest_t = trace.nearest_t[index];
      if (furthest_t < nearest_t) {
        for (int c = 0; c < kChunks; ++c) {
          const WideV ahead = hn::Sub(hn::Set(d, nearest_t), walk.t.chunk[c]);
          WideV& own = gap.chunk[c];
          own = hn::IfThenElse(mask_of(reached, c), hn::Min(own, ahead), own);
        }
        continue;
      }
      const LaneMask apart = segments.apart(index, walk.t, reached);
      any_apart |= apart != 0;
      reached &= ~apart;
      if (reached == 0) continue;
    }
    const PacketSegments& segment = segments.compute(index, reached);
    if (segments.has_windows(index)) aim_at_crossings(segments, index, reached, walk.t, gap);
    LaneMask at_start = 0;
    LaneMask at_end = 0;
    for (int c = 0; c < kChunks; ++c) {
      const WideV t = walk.t.chunk[c];
      const WideV to_start = hn::Abs(hn::Sub(hn::Load(d, segment.start + first_lane(c)), t));
      const WideV to_end = hn::Abs(hn::Sub(hn::Load(d, segment.end + first_lane(c)), t));
      const WideM is_start = hn::Eq(to_start, hn::Zero(d));
      const WideM is_end = hn::Eq(to_end, hn::Zero(d));
      gap.chunk[c] = hn::IfThenElse(is_start, gap.chunk[c], hn::Min(gap.chunk[c], to_start));
      gap.chunk[c] = hn::IfThenElse(is_end, gap.chunk[c], hn::Min(gap.chunk[c], to_end));
      at_start |= bits_of(is_start, c);
      at_end |= bits_of(is_end, c);
    }
    const LaneMask here = (at_start | at_end) & reached;
    several |= here & found;
    const LaneMask own = here & ~found;
    if (own == 0) continue;
    found |= own;
    const LaneMask on_cap = (at_start & segment.start_on_cap) | (at_end & segment.end_on_cap);
    hits.on_cap |= on_cap & own;
    fill_lanes(own, index, hits.index);
    Lanes3<Wide> normals[kChunks];
    segments.find_normals(index, own, walk.t, on_cap, normals);
    const WideV sign = outward_sign(trace, index);
    for (const int c : ChunksOf(own)) {
      result.normal[c] = if_then_else(mask_of(own, c), scaled(normals[c], sign), result.normal[c]);
    }
  }
  LaneMask together = 0;
  for (int c = 0; c < kChunks; ++c) {
    const Lanes3<Wide> direction = load3(d, rays.direction, first_lane(c));
    const WideV facing = hn::Abs(dot(d, result.normal[c], direction));
    const WideV thickness = hn::Mul(gap.chunk[c], facing);
    together |= bits_of(hn::Le(thickness, hn::Set(d, parameters.thickness_tolerance)), c);
    if (any_apart) {
      // At this cosine a separation by kApart measures just one tolerance along the normal.
      const WideV cosine2 =
          hn::Mul(hn::Mul(facing, facing), hn::Load(d, rays.inverse_length2 + first_lane(c)));
      together |= bits_of(hn::Le(cosine2, hn::Set(d, 1 / (kApart * kApart))), c);
    }
    store3(d, result.normal[c], hits.normal, first_lane(c));
    result.facing.chunk[c] = facing;
  }
  result.unclear = lanes & (together | several | ~found);
  return result;
}

HWY_INLINE void take_hits(const Walk& walk, LaneMask lanes, PacketHits& hits) {
  for (int c = 0; c < kChunks; ++c) hn::Store(walk.t.chunk[c], Wide(), hits.t + first_lane(c));
  hits.hits = lanes;
  hits.on_cap = 0;
  std::fill_n(hits.index, kPacketRays, 0u);
}

HWY_INLINE Walk walk_from(const double* start, LaneMask lanes) {
  const Wide d;
  Walk walk;
  walk.live = lanes;
  for (int c = 0; c < kChunks; ++c) {
    walk.t.chunk[c] = hn::Load(d, start + first_lane(c));
  }
  return walk;
}

HWY_INLINE void resolve_lanes(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                              const TraceList& list, const TraceParameters& parameters,
                              ListSegments& segments, PacketWorkspace& workspace,
                              PacketHits& hits) {
  if (lanes == 0) return;
  segments.compute_all(lanes);
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
    const LaneMask bit = LaneMask{1} << lane;
    RayResolver resolver(frame, rays, lane, list, parameters, segments, workspace);
    const auto shown = resolver.resolve(hits.t[lane], (hits.eye_inside & bit) != 0);
    if (!shown) continue;
    hits.hits |= bit;
    hits.t[lane] = shown->t;
    hits.index[lane] = shown->index;
    hits.on_cap = (hits.on_cap & ~bit) | (shown->on_cap ? bit : 0);
    const Vec3 normal = segments.normal_at(shown->index, lane, shown->t, shown->on_cap);
    const double sign = is_complement(list, shown->index) ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis) hits.normal[axis][lane] = sign * normal[axis];
  }
}

/// Finds the hits of lanes at whose first boundary, or at the one behind it, other crossings may
/// coincide. Lanes whose coincidences are plain (coincidences-inl.hpp) go on from one to
/// the next together. The others are left to RayResolver, one by one.
HWY_INLINE void resolve_coincidences(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                                     const TraceList& list, const TraceParameters& parameters,
                                     const double* leave, Walk walk, ListSegments& segments,
                                     PacketWorkspace& workspace, PacketHits& hits) {
  if (lanes == 0) return;
  workspace.resolved_rays += static_cast<uint64_t>(std::popcount(lanes));
  hits.hits &= ~lanes;
  CoincidenceFinder finder(rays, list, parameters, segments, workspace);
  LaneMask unclear = 0;
  LaneMask shows_next = parameters.boundary == Boundary::kFirst ? lanes : 0;
  LaneMask value = hits.eye_inside;
  PacketV from;
  for (int c = 0; c < kChunks; ++c) from.chunk[c] = hn::Set(Wide(), frame.first_t);
  for (LaneMask open = lanes; open != 0;) {
    LaneMask ended = 0;
    LaneMask turned = 0;
    for (const bool held : {false, true}) {
      const LaneMask group = open & (held ? value : ~value);
      if (group == 0) continue;
      const Coincidences coincidences = finder.find(walk, group, held, from);
      finder.show(coincidences.turned & shows_next, hits);
      unclear |= group & ~coincidences.plain;
      ended |= (group & ~coincidences.plain) | (coincidences.turned & shows_next);
      turned |= coincidences.turned;
      for (int c = 0; c < kChunks; ++c) {
        const WideM mask = mask_of(group, c);
        from.chunk[c] = hn::IfThenElse(mask, coincidences.end.chunk[c], from.chunk[c]);
        walk.t.chunk[c] = hn::IfThenElse(mask, coincidences.end.chunk[c], walk.t.chunk[c]);
      }
    }
    segments.forget_apart(open);
    shows_next |= turned;
    value ^= turned;
    walk.live = open & ~ended;
    open = walk_to_change(list, segments, value, leave, walk);
  }
  resolve_lanes(frame, rays, unclear, list, parameters, segments, workspace, hits);
}

/// The ends of whole rays.
struct alignas(64) WholeRays {
  explicit WholeRays(const FrameRays& frame) {
    std::fill_n(enter, kPacketRays, frame.first_t);
    std::fill_n(leave, kPacketRays, std::numeric_limits<double>::max());
  }
  double enter[kPacketRays], leave[kPacketRays];
};

/// Returns the lanes with v ≤ most.
HWY_INLINE LaneMask lanes_up_to(const PacketV& v, const double* most) {
  const Wide d;
  LaneMask result = 0;
  for (int c = 0; c < kChunks; ++c) {
    result |= bits_of(hn::Le(v.chunk[c], hn::LoadU(d, most + first_lane(c))), c);
  }
  return result;
}

/// The first boundaries of a packet's rays.
struct FirstBoundaries {
  Walk walk;             // stands at them
  LaneMask arrived = 0;  // the lanes that have one
};

/// Walks whole rays to their first boundaries, of those up to `last_t`. Sets hits.eye_inside, and
/// makes the boundaries the hits, whose crossings are still to be found.
HWY_INLINE FirstBoundaries walk_to_first_boundaries(const FrameRays& frame, LaneMask lanes,
                                                    const TraceList& list, ListSegments& segments,
                                                    const WholeRays& whole, const double* last_t,
                                                    PacketHits& hits) {
  FirstBoundaries first{walk_from(whole.enter, lanes)};
  Walk& walk = first.walk;
  if (list.earliest_t > frame.first_t) {
    const bool value = walk_to_first_crossing(list, segments, walk);
    hits.eye_inside = value ? kAllLanes : 0;
    walk.live &= lanes_up_to(walk.t, last_t);
  } else {
    hits.eye_inside = value_of(list, segments, walk);
  }
  first.arrived = walk_to_change(list, segments, hits.eye_inside, last_t, walk);
  take_hits(walk, first.arrived, hits);
  hits.undecided = 0;
  return first;
}

/// Finds the boundary behind the first one, of lanes whose first boundary is no coincidence and
/// where `walk` stands. Returns the lanes on which the boundary behind may be one.
HWY_INLINE LaneMask walk_on_behind(const RayPacket& rays, LaneMask lanes, const TraceList& list,
                                   const TraceParameters& parameters, ListSegments& segments,
                                   const WholeRays& whole, Walk walk, PacketHits& hits) {
  walk.live = lanes;
  const LaneMask arrived = walk_to_change(list, segments, ~hits.eye_inside, whole.leave, walk);
  take_hits(walk, arrived, hits);
  if (arrived == 0) return 0;
  const LaneMask unclear =
      show_crossings(rays, list, parameters, segments, walk, arrived, hits).unclear;
  hits.hits &= ~unclear;
  return unclear;
}

/// Finds the boundary behind the first one by the letter of the definition.
HWY_NOINLINE static void resolve_behind(const FrameRays& frame, const RayPacket& rays,
                                        LaneMask lanes, const TraceList& list,
                                        const TraceParameters& parameters,
                                        PacketWorkspace& workspace, PacketHits& hits) {
  if (lanes == 0) return;
  ListSegments segments(frame, rays, list, parameters, workspace);
  const WholeRays whole(frame);
  PacketHits resolved;
  const FirstBoundaries first =
      walk_to_first_boundaries(frame, lanes, list, segments, whole, whole.leave, resolved);
  resolve_coincidences(frame, rays, first.arrived, list, parameters, whole.leave, first.walk,
                       segments, workspace, resolved);
  const LaneMask found = lanes & resolved.hits;
  hits.hits |= found;
  hits.on_cap = (hits.on_cap & ~found) | (resolved.on_cap & found);
  for_each_lane(found, [&](uint32_t lane) {
    hits.t[lane] = resolved.t[lane];
    hits.index[lane] = resolved.index[lane];
    for (int axis = 0; axis < 3; ++axis) hits.normal[axis][lane] = resolved.normal[axis][lane];
  });
}

void trace_packet_sides(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                        const TraceList& list, const TraceParameters& parameters,
                        const PacketLimits* limits, const GoesOn& goes_on,
                        PacketWorkspace& workspace, PacketHits& front, PacketHits& behind) {
  workspace.rays += static_cast<uint64_t>(std::popcount(lanes));
  workspace.segment_store.clear();
  ListSegments segments(frame, rays, list, parameters, workspace);
  const WholeRays whole(frame);
  const FirstBoundaries first = walk_to_first_boundaries(
      frame, lanes, list, segments, whole, limits ? limits->last_t : whole.leave, front);
  behind.hits = behind.undecided = 0;
  behind.eye_inside = front.eye_inside;
  LaneMask wanted = first.arrived;
  if (wanted == 0) return;
  LaneMask unclear =
      show_crossings(rays, list, parameters, segments, first.walk, wanted, front).unclear;
  if (goes_on) {
    const TraceParameters of_front{parameters.thickness_tolerance, Boundary::kFirst};
    resolve_coincidences(frame, rays, unclear, list, of_front, whole.leave, first.walk, segments,
                         workspace, front);
    wanted = front.hits & goes_on(front);
    unclear &= wanted;
  }
  unclear |= walk_on_behind(rays, wanted & ~unclear, list, parameters, segments, whole, first.walk,
                            behind);
  resolve_behind(frame, rays, unclear, list, parameters, workspace, behind);
}

void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceParameters& parameters,
                  const PacketLimits* limits, PacketWorkspace& workspace, PacketHits& hits) {
  if (parameters.boundary == Boundary::kBehind) {
    PacketHits first;
    csgcore::HWY_NAMESPACE::trace_packet_sides(frame, rays, lanes, list, parameters, limits,
                                               GoesOn(), workspace, first, hits);
    return;
  }
  workspace.rays += static_cast<uint64_t>(std::popcount(lanes));
  workspace.segment_store.clear();
  ListSegments segments(frame, rays, list, parameters, workspace);
  const WholeRays whole(frame);
  const FirstBoundaries first = walk_to_first_boundaries(
      frame, lanes, list, segments, whole, limits ? limits->last_t : whole.leave, hits);
  if (first.arrived == 0) return;
  const LaneMask unclear =
      show_crossings(rays, list, parameters, segments, first.walk, first.arrived, hits).unclear;
  resolve_coincidences(frame, rays, unclear, list, parameters, whole.leave, first.walk, segments,
                       workspace, hits);
}

void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceParameters& parameters, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits) {
  const Wide d;
  ListSegments segments(frame, rays, list, parameters, workspace);
  Walk walk = walk_from(range.enter, lanes);
  hits.eye_inside = eye_inside & known;
  if ((lanes & ~known) != 0) hits.eye_inside |= value_of(list, segments, walk) & ~known;
  const LaneMask arrived = walk_to_change(list, segments, hits.eye_inside, range.leave, walk);
  take_hits(walk, arrived, hits);
  hits.undecided = parameters.boundary == Boundary::kBehind ? arrived : arrived & ~walk.moved;
  const LaneMask left = arrived & ~hits.undecided;
  if (left == 0) return;
  const Crossings crossings = show_crossings(rays, list, parameters, segments, walk, left, hits);
  hits.undecided |= crossings.unclear;
  // All crossings that may coincide with the hit must lie where the list is valid.
  const auto thinnest2 =
      hn::Set(d, parameters.thickness_tolerance * parameters.thickness_tolerance);
  for (int c = 0; c < kChunks; ++c) {
    const WideV facing = crossings.facing.chunk[c];
    const auto valid2 = hn::Mul(hn::Set(d, range.margin * range.margin),
                                hn::Load(d, rays.inverse_length2 + first_lane(c)));
    const auto thickness2 = hn::Mul(hn::Mul(facing, facing), valid2);
    hits.undecided |= bits_of(hn::Not(hn::Ge(thickness2, thinnest2)), c) & left;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(trace_packet);
CSGCORE_SIMD_EXPORT(trace_packet_sides);
CSGCORE_SIMD_EXPORT(trace_packet_in_range);

void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceParameters& parameters,
                  const PacketLimits* limits, PacketWorkspace& workspace, PacketHits& hits) {
  CSGCORE_SIMD(trace_packet)(frame, rays, lanes, list, parameters, limits, workspace, hits);
}

void trace_packet_sides(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                        const TraceList& list, const TraceParameters& parameters,
                        const PacketLimits* limits, const GoesOn& goes_on,
                        PacketWorkspace& workspace, PacketHits& front, PacketHits& behind) {
  CSGCORE_SIMD(trace_packet_sides)
  (frame, rays, lanes, list, parameters, limits, goes_on, workspace, front, behind);
}

void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceParameters& parameters, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits) {
  CSGCORE_SIMD(trace_packet_in_range)
  (frame, rays, lanes, range, list, parameters, known, eye_inside, workspace, hits);
}

}  // namespace csgcore
#endif  // HWY_ONCE
