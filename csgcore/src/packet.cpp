// Compiled once per instruction set by Highway. Multiplications and additions are never fused, and
// what one lane gets does not depend on the others: every instruction set gives the same bits.
#include "packet.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "simd.hpp"

// Vectors whose length is not known to the compiler cannot stand in arrays.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "packet.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "primitive-inl.hpp"
#include "resolve-inl.hpp"
#include "walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// origin + base_s·direction − pivot without rounding the large terms, which cancel: the product is
/// exact in two parts (Dekker 1971), the difference too (Knuth's TwoSum).
HWY_INLINE WideV rebased(WideV origin, WideV direction, double base_s, double pivot) {
  const Wide d;
  const WideV split = hn::Mul(direction, hn::Set(d, 0x1p27 + 1.0));
  const WideV high = hn::Sub(split, hn::Sub(split, direction));
  const WideV low = hn::Sub(direction, high);
  const WideV minus = hn::Set(d, -pivot);
  const WideV sum = hn::Add(origin, minus);
  const WideV part = hn::Sub(sum, origin);
  const WideV lost = hn::Add(hn::Sub(origin, hn::Sub(sum, part)), hn::Sub(minus, part));
  const WideV base = hn::Set(d, base_s);
  return hn::Add(hn::Add(sum, hn::Mul(base, high)), hn::Add(hn::Mul(base, low), lost));
}

/// pixel_ray, lane by lane and operation by operation.
void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  const Wide d;
  const View& view = frame.view;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    const auto u = hn::Load(d, laterals.u + first);
    const auto v = hn::Load(d, laterals.v + first);
    WideV length2 = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const auto lateral =
          hn::Add(hn::Mul(u, hn::Set(d, view.right[axis])), hn::Mul(v, hn::Set(d, view.up[axis])));
      const auto eye = hn::Set(d, view.eye[axis]);
      const auto forward = hn::Set(d, view.forward[axis]);
      const bool is_perspective = view.projection == Projection::kPerspective;
      const auto origin = is_perspective ? eye : hn::Add(eye, lateral);
      const auto direction = is_perspective ? hn::Add(forward, lateral) : forward;
      hn::Store(rebased(origin, direction, frame.base_s, frame.pivot[axis]), d,
                rays.origin[axis] + first);
      hn::Store(direction, d, rays.direction[axis] + first);
      length2 = hn::Add(length2, hn::Mul(direction, direction));
    }
    hn::Store(hn::Div(hn::Set(d, 1.0), length2), d, rays.inverse_length2 + first);
  }
}

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  intersect_packet(frame, rays, primitive, segments);
}

/// Lanes of `lanes` that show the same literal as the lowest of them.
HWY_INLINE LaneMask lanes_of_first(const PacketHits& hits, LaneMask lanes) {
  const uint32_t index = hits.index[std::countr_zero(lanes)];
  LaneMask same = 0;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    same |= LaneMask{hits.index[lane] == index} << lane;
  }
  return same & lanes;
}

HWY_INLINE bool is_complement(const TraceList& list, uint32_t index) {
  return (list.list->primitive[index] & CellList::kComplementBit) != 0;
}

/// The normals of the lanes, outward of the solid (paper §3.2, step 4).
HWY_INLINE void find_normals(const FrameRays& frame, const RayPacket& rays, const TraceList& list,
                             LaneMask lanes, PacketHits& hits) {
  const Wide d;
  while (lanes != 0) {
    const LaneMask same = lanes_of_first(hits, lanes);
    const uint32_t index = hits.index[std::countr_zero(lanes)];
    lanes &= ~same;
    const uint32_t entry = list.list->primitive[index];
    const CanonicalPrimitive& primitive = list.primitives[entry & kPrimitiveBits];
    const auto sign = hn::Set(d, is_complement(list, index) ? -1.0 : 1.0);
    for (int c = 0; c < kChunks; ++c) {
      const size_t first = first_lane(c);
      const WideM wanted = mask_of(same, c);
      if (hn::AllFalse(d, wanted)) continue;
      const auto normal = scaled(normal_of(d, primitive, frame.pivot, load_rays(d, rays, first),
                                           hn::Load(d, hits.t + first), mask_of(hits.on_cap, c)),
                                 sign);
      hn::BlendedStore(normal.x, wanted, d, hits.normal[0] + first);
      hn::BlendedStore(normal.y, wanted, d, hits.normal[1] + first);
      hn::BlendedStore(normal.z, wanted, d, hits.normal[2] + first);
    }
  }
}

/// How far, in τ, another crossing must lie from each hit not to be taken together with it.
HWY_INLINE PacketV reach_of(const RayPacket& rays, const TraceSubject& subject,
                            const PacketHits& hits) {
  const Wide d;
  PacketV reach;
  for (int c = 0; c < kChunks; ++c) {
    const auto normal = load3(d, hits.normal, first_lane(c));
    const auto facing = hn::Abs(dot(d, normal, load3(d, rays.direction, first_lane(c))));
    reach.chunk[c] = hn::Div(hn::Set(d, subject.thinnest_piece), facing);
  }
  return reach;
}

/// The lanes whose hit has another crossing within its reach.
HWY_INLINE LaneMask coincident_lanes(const TraceList& trace, ListSegments& segments,
                                     const PacketV& reach, const Walk& walk, LaneMask lanes) {
  const Wide d;
  PacketV sum;
  for (int c = 0; c < kChunks; ++c) sum.chunk[c] = hn::Add(walk.t.chunk[c], reach.chunk[c]);
  const double furthest = largest(sum, lanes);
  PacketV close;
  for (int c = 0; c < kChunks; ++c) close.chunk[c] = hn::Zero(d);
  const WideV one = hn::Set(d, 1.0);
  for (uint32_t index = 0; index < trace.list->count(); ++index) {
    if (segments.is_missed(index) || segments.is_beyond(index, furthest)) continue;
    const PacketSegments& segment = segments.compute(index);
    const WideV start_event = hn::Set(d, event_code(index, false));
    const WideV end_event = hn::Set(d, event_code(index, true));
    for (int c = 0; c < kChunks; ++c) {
      const WideV t = walk.t.chunk[c];
      const WideV event = walk.event.chunk[c];
      const auto near = [&](const double* ends, WideV own) {
        const WideV gap = hn::Abs(hn::Sub(hn::Load(d, ends + first_lane(c)), t));
        return hn::And(hn::Le(gap, reach.chunk[c]), hn::Ne(event, own));
      };
      const WideM any = hn::Or(near(segment.start, start_event), near(segment.end, end_event));
      close.chunk[c] = hn::IfThenElse(any, one, close.chunk[c]);
    }
  }
  LaneMask result = 0;
  for (int c = 0; c < kChunks; ++c) result |= bits_of(hn::Eq(close.chunk[c], one), c);
  return result & lanes;
}

HWY_INLINE void take_hits(const Walk& walk, LaneMask lanes, const PacketWorkspace& workspace,
                          PacketHits& hits) {
  const Wide d;
  alignas(64) double events[kPacketRays];
  for (int c = 0; c < kChunks; ++c) {
    hn::Store(walk.t.chunk[c], d, hits.t + first_lane(c));
    hn::Store(walk.event.chunk[c], d, events + first_lane(c));
  }
  hits.hits = lanes;
  hits.on_cap = 0;
  std::fill_n(hits.index, kPacketRays, 0u);
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (events[lane] < 0) continue;  // no crossing
    const uint32_t code = static_cast<uint32_t>(events[lane]);
    hits.index[lane] = code / 2;
    const PacketSegments& segments = workspace.segments[code / 2];
    const LaneMask caps = (code & 1) != 0 ? segments.end_on_cap : segments.start_on_cap;
    hits.on_cap |= caps & (LaneMask{1} << lane);
  }
}

/// Lanes that arrived at no crossing: the value had changed where the walk began.
HWY_INLINE LaneMask lanes_without_event(const Walk& walk, LaneMask lanes) {
  const Wide d;
  LaneMask result = 0;
  for (int c = 0; c < kChunks; ++c) {
    result |= bits_of(hn::Lt(walk.event.chunk[c], hn::Zero(d)), c);
  }
  return result & lanes;
}

HWY_INLINE Walk walk_from(const double* start, LaneMask lanes) {
  const Wide d;
  Walk walk;
  walk.live = lanes;
  for (int c = 0; c < kChunks; ++c) {
    walk.t.chunk[c] = hn::Load(d, start + first_lane(c));
    walk.event.chunk[c] = hn::Set(d, -1.0);
  }
  return walk;
}

HWY_INLINE void resolve_lanes(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                              const TraceList& list, const TraceSubject& subject,
                              ListSegments& segments, PacketWorkspace& workspace,
                              PacketHits& hits) {
  if (lanes == 0) return;
  segments.compute_all();
  LaneMask found = 0;
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
    const LaneMask bit = LaneMask{1} << lane;
    ++workspace.resolved_rays;
    RayResolver resolver(frame, rays, lane, list, subject, workspace);
    const auto shown = resolver.resolve(hits.t[lane], (hits.eye_inside & bit) != 0);
    if (!shown) continue;
    found |= bit;
    hits.t[lane] = shown->event.t;
    hits.index[lane] = shown->event.index;
    hits.on_cap = (hits.on_cap & ~bit) | (shown->on_cap ? bit : 0);
  }
  hits.hits = (hits.hits & ~lanes) | found;
  find_normals(frame, rays, list, found, hits);
}

void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceSubject& subject, PacketWorkspace& workspace,
                  PacketHits& hits) {
  constexpr double kEndless = std::numeric_limits<double>::max();
  alignas(64) double start[kPacketRays], leave[kPacketRays];
  std::fill_n(start, kPacketRays, frame.first_t);
  std::fill_n(leave, kPacketRays, kEndless);
  workspace.rays += static_cast<uint64_t>(std::popcount(lanes));
  ListSegments segments(frame, rays, list, workspace);
  Walk walk = walk_from(start, lanes);
  if (list.earliest_t > frame.first_t) {
    const bool value = walk_to_first_crossing(list, segments, kEndless, walk);
    hits.eye_inside = value ? kAllLanes : 0;
  } else {
    hits.eye_inside = value_of(list, segments, walk);
  }
  const LaneMask arrived = walk_to_change(list, segments, hits.eye_inside, leave, walk);
  take_hits(walk, arrived, workspace, hits);
  hits.undecided = 0;
  if (arrived == 0) return;
  LaneMask unclear = lanes_without_event(walk, arrived);
  if (subject.boundary == Boundary::kBehind) {
    unclear = arrived;
  } else {
    find_normals(frame, rays, list, arrived & ~unclear, hits);
    const PacketV reach = reach_of(rays, subject, hits);
    unclear |= coincident_lanes(list, segments, reach, walk, arrived & ~unclear);
  }
  resolve_lanes(frame, rays, unclear, list, subject, segments, workspace, hits);
}

void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceSubject& subject, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits) {
  const Wide d;
  ListSegments segments(frame, rays, list, workspace);
  Walk walk = walk_from(range.enter, lanes);
  hits.eye_inside = eye_inside & known;
  if ((lanes & ~known) != 0) hits.eye_inside |= value_of(list, segments, walk) & ~known;
  const LaneMask arrived = walk_to_change(list, segments, hits.eye_inside, range.leave, walk);
  take_hits(walk, arrived, workspace, hits);
  hits.undecided = lanes_without_event(walk, arrived);
  if (subject.boundary == Boundary::kBehind) hits.undecided = arrived;
  if (hits.undecided == arrived) return;
  find_normals(frame, rays, list, arrived & ~hits.undecided, hits);
  const PacketV reach = reach_of(rays, subject, hits);
  hits.undecided |= coincident_lanes(list, segments, reach, walk, arrived & ~hits.undecided);
  for (int c = 0; c < kChunks; ++c) {
    const auto inverse_length2 = hn::Load(d, rays.inverse_length2 + first_lane(c));
    const auto reach2 = hn::Mul(reach.chunk[c], reach.chunk[c]);
    const auto valid2 = hn::Mul(hn::Set(d, range.margin * range.margin), inverse_length2);
    hits.undecided |= bits_of(hn::Not(hn::Le(reach2, valid2)), c) & arrived;
  }
}

void invert_directions(const RayPacket& rays, PacketInverses& inverses) {
  const Wide d;
  for (int axis = 0; axis < 3; ++axis) {
    for (int c = 0; c < kChunks; ++c) {
      const auto direction = hn::Load(d, rays.direction[axis] + first_lane(c));
      const auto none = hn::Eq(direction, hn::Zero(d));
      const auto inverse =
          hn::Div(hn::Set(d, 1.0), hn::IfThenElse(none, hn::Set(d, 1.0), direction));
      hn::Store(hn::IfThenElse(none, hn::Set(d, kInfinity), inverse), d,
                inverses.inverse[axis] + first_lane(c));
    }
  }
}

RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far) {
  const Wide d;
  RangeSplit result{0, 0};
  for (int c = 0; c < kChunks; ++c) {
    const size_t first = first_lane(c);
    const auto gap = hn::Sub(hn::Set(d, plane), hn::Load(d, rays.origin[axis] + first));
    const auto product = hn::Mul(gap, hn::Load(d, inverses.inverse[axis] + first));
    // A ray within the plane (0·∞) counts as beyond.
    const auto t = hn::IfThenElse(hn::Eq(product, product), product, hn::Set(d, -kInfinity));
    const auto enter = hn::Load(d, range.enter + first);
    const auto leave = hn::Load(d, range.leave + first);
    result.before |= bits_of(hn::Le(enter, t), c);
    result.beyond |= bits_of(hn::Le(t, leave), c);
    hn::Store(hn::Max(enter, t), d, far.enter + first);
    hn::Store(leave, d, far.leave + first);
    hn::Store(hn::Min(leave, t), d, range.leave + first);
  }
  far.margin = range.margin;
  return result;
}

/// 0.2 + |n · light| (openscad.md §4).
HWY_INLINE WideV openscad_shade(const ShadeSettings& settings, const PacketHits& hits, int chunk) {
  const Wide d;
  constexpr double kAmbient = 0.2;
  const auto normal = load3(d, hits.normal, first_lane(chunk));
  return hn::Add(hn::Set(d, kAmbient), hn::Abs(dot(d, normal, broadcast(d, settings.light_world))));
}

HWY_INLINE void shade_phong(const ShadeSettings& settings, const FrameRays& frame,
                            const RayPacket& rays, LaneMask lanes, const Vec3& base,
                            const PacketHits& hits, PacketColors& colors) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const auto at = [lane](const double(&v)[3][kPacketRays]) {
      return Vec3{v[0][lane], v[1][lane], v[2][lane]};
    };
    const Vec3 direction = at(rays.direction);
    const Vec3 position = frame.pivot + (at(rays.origin) + hits.t[lane] * direction);
    const Vec3 color =
        phong_color(base / 255.0, position, at(hits.normal), direction, settings.phong);
    for (int channel = 0; channel < 3; ++channel)
      colors.rgb[channel][lane] = 255.0 * color[channel];
  }
}

HWY_INLINE Vec3 base_color(const ShadeSettings& settings, const TraceList& list, uint32_t index,
                           bool eye_inside) {
  const std::optional<Color>& own =
      list.primitives[list.list->primitive[index] & kPrimitiveBits].color;
  if (own) return 255.0 * Vec3{own->r, own->g, own->b};
  return is_complement(list, index) && !eye_inside ? settings.back : settings.front;
}

void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors) {
  const Wide d;
  for (LaneMask lanes = hits.hits; lanes != 0;) {
    const int first = std::countr_zero(lanes);
    const bool eye_inside = (hits.eye_inside >> first & 1) != 0;
    const LaneMask same =
        lanes_of_first(hits, lanes) & (eye_inside ? hits.eye_inside : ~hits.eye_inside);
    const Vec3 base = base_color(settings, list, hits.index[first], eye_inside);
    lanes &= ~same;
    if (settings.shading == Shading::kPhong) {
      shade_phong(settings, frame, rays, same, base, hits, colors);
      continue;
    }
    for (int c = 0; c < kChunks; ++c) {
      const auto shade = openscad_shade(settings, hits, c);
      for (int channel = 0; channel < 3; ++channel) {
        const auto value = hn::Mul(hn::Set(d, base[channel]), shade);
        hn::BlendedStore(hn::Min(value, hn::Set(d, 255.0)), mask_of(same, c), d,
                         colors.rgb[channel] + first_lane(c));
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(make_rays);
CSGCORE_SIMD_EXPORT(intersect);
CSGCORE_SIMD_EXPORT(trace_packet);
CSGCORE_SIMD_EXPORT(trace_packet_in_range);
CSGCORE_SIMD_EXPORT(shade_packet);
CSGCORE_SIMD_EXPORT(invert_directions);
CSGCORE_SIMD_EXPORT(split_range);

void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  CSGCORE_SIMD(make_rays)(frame, laterals, rays);
}

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  CSGCORE_SIMD(intersect)(frame, rays, primitive, segments);
}

void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceSubject& subject, PacketWorkspace& workspace,
                  PacketHits& hits) {
  CSGCORE_SIMD(trace_packet)(frame, rays, lanes, list, subject, workspace, hits);
}

void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceSubject& subject, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits) {
  CSGCORE_SIMD(trace_packet_in_range)
  (frame, rays, lanes, range, list, subject, known, eye_inside, workspace, hits);
}

void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors) {
  CSGCORE_SIMD(shade_packet)(settings, frame, rays, list, hits, colors);
}

void invert_directions(const RayPacket& rays, PacketInverses& inverses) {
  CSGCORE_SIMD(invert_directions)(rays, inverses);
}

RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far) {
  return CSGCORE_SIMD(split_range)(rays, inverses, axis, plane, range, far);
}

}  // namespace csgcore
#endif  // HWY_ONCE
