// Compiled once per instruction set by Highway. Multiplications and additions are never fused, and
// what one lane gets does not depend on the others: every instruction set gives the same bits.
#include "packet.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "screen_outline.hpp"
#include "simd.hpp"

// Vectors whose length is not known to the compiler cannot stand in arrays.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "packet.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "clusters-inl.hpp"
#include "primitive-inl.hpp"
#include "resolve-inl.hpp"
#include "walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// a + b in two parts, without rounding (Knuth's TwoSum).
struct ExactSum {
  WideV sum, lost;
};
HWY_INLINE ExactSum exact_sum(WideV a, WideV b) {
  const WideV sum = hn::Add(a, b);
  const WideV part = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, part)), hn::Sub(b, part))};
}

/// offset + base_s·direction without rounding the large terms, which cancel: the product is exact
/// in two parts (Dekker 1971).
HWY_INLINE WideV rebased(const ExactSum& offset, WideV base_s, WideV direction) {
  const Wide d;
  const WideV split = hn::Mul(direction, hn::Set(d, 0x1p27 + 1.0));
  const WideV high = hn::Sub(split, hn::Sub(split, direction));
  const WideV low = hn::Sub(direction, high);
  return hn::Add(hn::Add(offset.sum, hn::Mul(base_s, high)),
                 hn::Add(hn::Mul(base_s, low), offset.lost));
}

/// pixel_ray, lane by lane and operation by operation, in so many chunks.
template <int kCount>
HWY_INLINE void write_rays(const FrameRays& frame, const PacketV& u, const PacketV& v,
                           RayPacket& rays) {
  const Wide d;
  const View& view = frame.view;
  const bool is_perspective = view.projection == Projection::kPerspective;
  const WideV base_s = hn::Set(d, frame.base_s);
  PacketV length2;
  for (int c = 0; c < kCount; ++c) length2.chunk[c] = hn::Zero(d);
  for (int axis = 0; axis < 3; ++axis) {
    const WideV right = hn::Set(d, view.right[axis]);
    const WideV up = hn::Set(d, view.up[axis]);
    const WideV forward = hn::Set(d, view.forward[axis]);
    const WideV eye = hn::Set(d, view.eye[axis]);
    const WideV minus_pivot = hn::Set(d, -frame.pivot[axis]);
    const ExactSum from_eye = exact_sum(eye, minus_pivot);
    for (int c = 0; c < kCount; ++c) {
      const WideV lateral = hn::Add(hn::Mul(u.chunk[c], right), hn::Mul(v.chunk[c], up));
      const WideV direction = is_perspective ? hn::Add(forward, lateral) : forward;
      const ExactSum offset =
          is_perspective ? from_eye : exact_sum(hn::Add(eye, lateral), minus_pivot);
      hn::Store(rebased(offset, base_s, direction), d, rays.origin[axis] + first_lane(c));
      hn::Store(direction, d, rays.direction[axis] + first_lane(c));
      length2.chunk[c] = hn::Add(length2.chunk[c], hn::Mul(direction, direction));
    }
  }
  for (int c = 0; c < kCount; ++c) {
    hn::Store(hn::Div(hn::Set(d, 1.0), length2.chunk[c]), d, rays.inverse_length2 + first_lane(c));
  }
}

template <int kCount>
HWY_INLINE void write_rays_through(const FrameRays& frame, const PacketLaterals& laterals,
                                   RayPacket& rays) {
  PacketV u, v;
  for (int c = 0; c < kCount; ++c) {
    u.chunk[c] = hn::Load(Wide(), laterals.u + first_lane(c));
    v.chunk[c] = hn::Load(Wide(), laterals.v + first_lane(c));
  }
  write_rays<kCount>(frame, u, v, rays);
}

void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  write_rays_through<kChunks>(frame, laterals, rays);
}

void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  write_rays_through<kFourChunks>(frame, laterals, rays);
}

void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays) {
  const Wide d;
  static_assert(kLanes <= kPacketWidth_px);
  PacketV u, v;
  for (int c = 0; c < kChunks; ++c) {
    const size_t column = first_lane(c) % kPacketWidth_px;
    const size_t row = first_lane(c) / kPacketWidth_px;
    u.chunk[c] = hn::LoadU(d, frame.u_of_column.data() + x + column);
    v.chunk[c] = hn::Set(d, frame.v_of_row[y + row]);
  }
  write_rays<kChunks>(frame, u, v, rays);
}

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  intersect_lanes(frame, rays, kAllLanes, primitive, segments);
}

void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments) {
  intersect_lanes(frame, rays, 0xF, primitive, segments);
}

void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]) {
  PacketV t;
  Lanes3<Wide> found[kChunks];
  for (int c = 0; c < kFourChunks; ++c) {
    t.chunk[c] = hn::Load(Wide(), segments.start + first_lane(c));
  }
  find_normals(frame, rays, 0xF, primitive, t, segments.start_on_cap, found);
  for (int c = 0; c < kFourChunks; ++c) store3(Wide(), found[c], normals, first_lane(c));
}

/// The lanes of a block that are in these columns and rows, by bits.
HWY_INLINE LaneMask lanes_in(uint32_t columns, uint32_t rows) {
  static_assert(kPacketWidth_px == 8 && kPacketHeight_px == 4);
  constexpr uint32_t kFirstOfRow = 0x01010101u;
  constexpr uint32_t kBitToRow = 0x00204081u;  // bit i goes to bit 8·i, among others
  const LaneMask whole_rows = ((rows & 0xFu) * kBitToRow & kFirstOfRow) * 0xFFu;
  return columns * kFirstOfRow & whole_rows;
}

/// The pixels of two blocks, one below the other from (x, y) on, that no line has beyond it.
HWY_INLINE uint64_t pixels_between(const ScreenOutline& outline, float x, float y) {
  static_assert(kPacketWidth_px == 8);
  const hn::CappedTag<float, kPacketWidth_px> d;
  uint64_t beyond = 0;
  for (size_t column = 0; column < kPacketWidth_px; column += hn::Lanes(d)) {
    const auto along = hn::Iota(d, static_cast<float>(column));
    // How far beyond a line the row's pixels are.
    const auto first_row = [&](int line) {
      const float first = outline.x[line] * x + outline.y[line] * y - outline.limit[line];
      return hn::Add(hn::Set(d, first), hn::Mul(hn::Set(d, outline.x[line]), along));
    };
    auto past0 = first_row(0);
    auto past1 = first_row(1);
    for (uint32_t row = 0; row < 2 * kPacketHeight_px; ++row) {
      const auto is_beyond = hn::Gt(hn::Max(past0, past1), hn::Zero(d));
      uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, is_beyond, bytes);
      beyond |= uint64_t{bytes[0]} << (kPacketWidth_px * row + column);
      past0 = hn::Add(past0, hn::Set(d, outline.y[0]));
      past1 = hn::Add(past1, hn::Set(d, outline.y[1]));
    }
  }
  return ~beyond;
}

void find_reached(const Extent* screen, const ScreenOutline* outlines,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below) {
  static_assert(kPacketWidth_px == 2 * kPacketHeight_px);
  const hn::CappedTag<double, 2> d;
  const hn::Rebind<int32_t, decltype(d)> integers;
  const hn::Rebind<uint32_t, decltype(d)> bits;
  const double origin[] = {static_cast<double>(x), static_cast<double>(y)};
  for (size_t i = 0; i < primitives.size(); ++i) {
    const Extent& extent = screen[primitives[i] & kPrimitiveBits];
    uint32_t inside[2];  // by column and row
    for (size_t axis = 0; axis < 2; axis += hn::Lanes(d)) {
      const auto center = hn::Sub(hn::LoadU(d, extent.center + axis), hn::LoadU(d, origin + axis));
      const auto half = hn::LoadU(d, extent.half + axis);
      const auto bit_of = [&](auto pixel) {
        const auto last = hn::Set(d, double{kPacketWidth_px});
        const auto limited = hn::Min(hn::Max(pixel, hn::Zero(d)), last);
        return hn::Shl(hn::Set(bits, 1u), hn::BitCast(bits, hn::DemoteTo(integers, limited)));
      };
      const auto low = bit_of(hn::Sub(center, half));
      const auto end = bit_of(hn::Add(hn::Add(center, half), hn::Set(d, 1.0)));
      hn::StoreU(hn::Sub(end, low), bits, inside + axis);
    }
    above[i] = lanes_in(inside[0], inside[1]);
    below[i] = lanes_in(inside[0], inside[1] >> kPacketHeight_px);
    if (extent.inside2 >= 0 || (above[i] | below[i]) == 0) continue;
    const uint64_t between = pixels_between(outlines[primitives[i] & kPrimitiveBits],
                                            static_cast<float>(x), static_cast<float>(y));
    above[i] &= static_cast<LaneMask>(between);
    below[i] &= static_cast<LaneMask>(between >> kPacketRays);
  }
}

LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance) {
  PacketV at;
  for (int c = 0; c < kChunks; ++c) at.chunk[c] = hn::LoadU(Wide(), t + first_lane(c));
  PacketPoints points;
  find_points(rays, at, distance, points);
  return lanes_apart(primitive, frame.pivot, points, distance);
}

HWY_INLINE bool is_complement(const TraceList& list, uint32_t index) {
  return (list.list->primitive[index] & CellList::kComplementBit) != 0;
}

/// What makes the primitive's normals those of the solid (paper §3.2, step 4).
HWY_INLINE WideV outward_sign(const TraceList& list, uint32_t index) {
  return hn::Set(Wide(), is_complement(list, index) ? -1.0 : 1.0);
}

/// The literal's normals at its crossings τ = t, outward of the solid.
HWY_INLINE Lanes3<Wide> outward_normal(const FrameRays& frame, const RayPacket& rays,
                                       const TraceList& list, uint32_t index, WideV t,
                                       LaneMask on_cap, int chunk) {
  const Wide d;
  const uint32_t entry = list.list->primitive[index];
  const CanonicalPrimitive& primitive = list.primitives[entry & kPrimitiveBits];
  return scaled(normal_of(d, primitive, frame.pivot, load_rays(d, rays, first_lane(chunk)), t,
                          mask_of(on_cap, chunk)),
                outward_sign(list, index));
}

/// What lies where the lanes stand.
struct Crossings {
  Lanes3<Wide> normal[kChunks];
  PacketV facing;    // |n·d|: thickness per τ
  LaneMask unclear;  // lanes with no crossing there, or several together
};

/// Looks for the crossings at which the lanes stand, and keeps in the hits what they show.
HWY_INLINE Crossings show_crossings(const FrameRays& frame, const RayPacket& rays,
                                    const TraceList& trace, const TraceSubject& subject,
                                    ListSegments& segments, const Walk& walk, LaneMask lanes,
                                    PacketHits& hits) {
  const Wide d;
  Crossings result;
  PacketV gap;  // to the next other crossing
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
    find_normals(frame, rays, own, segments.primitive(index), walk.t, on_cap, normals);
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
    together |= bits_of(hn::Le(thickness, hn::Set(d, subject.thinnest_piece)), c);
    if (any_apart) {
      // The cosine at which kApart is the thinnest piece.
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
                              const TraceList& list, const TraceSubject& subject,
                              ListSegments& segments, PacketWorkspace& workspace,
                              PacketHits& hits) {
  if (lanes == 0) return;
  segments.compute_all(lanes);
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
    const LaneMask bit = LaneMask{1} << lane;
    RayResolver resolver(frame, rays, lane, list, subject, workspace);
    const auto shown = resolver.resolve(hits.t[lane], (hits.eye_inside & bit) != 0);
    if (!shown) continue;
    hits.hits |= bit;
    hits.t[lane] = shown->event.t;
    hits.index[lane] = shown->event.index;
    hits.on_cap = (hits.on_cap & ~bit) | (shown->on_cap ? bit : 0);
    const int chunk = static_cast<int>(lane / kLanes);
    const WideV t = hn::Set(Wide(), shown->event.t);
    const auto normal =
        outward_normal(frame, rays, list, shown->event.index, t, hits.on_cap, chunk);
    hn::BlendedStore(normal.x, mask_of(bit, chunk), Wide(), hits.normal[0] + first_lane(chunk));
    hn::BlendedStore(normal.y, mask_of(bit, chunk), Wide(), hits.normal[1] + first_lane(chunk));
    hn::BlendedStore(normal.z, mask_of(bit, chunk), Wide(), hits.normal[2] + first_lane(chunk));
  }
}

/// The hits of lanes that stand at their first boundary, with which other crossings may coincide,
/// or which want the one behind it. Lanes whose cluster is plain go on from cluster to cluster
/// together; the others are left to the resolver, one by one.
HWY_INLINE void resolve_coincidences(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                                     const TraceList& list, const TraceSubject& subject,
                                     const double* leave, Walk walk, ListSegments& segments,
                                     PacketWorkspace& workspace, PacketHits& hits) {
  if (lanes == 0) return;
  workspace.resolved_rays += static_cast<uint64_t>(std::popcount(lanes));
  hits.hits &= ~lanes;
  ClusterFinder finder(frame, rays, list, subject, segments, workspace);
  LaneMask unclear = 0;
  LaneMask shows_next = subject.boundary == Boundary::kFirst ? lanes : 0;
  LaneMask value = hits.eye_inside;
  PacketV from;
  for (int c = 0; c < kChunks; ++c) from.chunk[c] = hn::Set(Wide(), frame.first_t);
  for (LaneMask open = lanes; open != 0;) {
    LaneMask ended = 0;
    LaneMask turned = 0;
    for (const bool held : {false, true}) {
      const LaneMask group = open & (held ? value : ~value);
      if (group == 0) continue;
      const Clusters clusters = finder.find(walk, group, held, from);
      finder.show(clusters.turned & shows_next, hits);
      unclear |= group & ~clusters.plain;
      ended |= (group & ~clusters.plain) | (clusters.turned & shows_next);
      turned |= clusters.turned;
      for (int c = 0; c < kChunks; ++c) {
        const WideM mask = mask_of(group, c);
        from.chunk[c] = hn::IfThenElse(mask, clusters.end.chunk[c], from.chunk[c]);
        walk.t.chunk[c] = hn::IfThenElse(mask, clusters.end.chunk[c], walk.t.chunk[c]);
      }
    }
    segments.forget_apart(open);
    shows_next |= turned;
    value ^= turned;
    walk.live = open & ~ended;
    open = walk_to_change(list, segments, value, leave, walk);
  }
  resolve_lanes(frame, rays, unclear, list, subject, segments, workspace, hits);
}

void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceSubject& subject, PacketWorkspace& workspace,
                  PacketHits& hits) {
  constexpr double kEndless = std::numeric_limits<double>::max();
  alignas(64) double start[kPacketRays], leave[kPacketRays];
  std::fill_n(start, kPacketRays, frame.first_t);
  std::fill_n(leave, kPacketRays, kEndless);
  workspace.rays += static_cast<uint64_t>(std::popcount(lanes));
  ListSegments segments(frame, rays, list, subject, workspace);
  Walk walk = walk_from(start, lanes);
  if (list.earliest_t > frame.first_t) {
    const bool value = walk_to_first_crossing(list, segments, walk);
    hits.eye_inside = value ? kAllLanes : 0;
  } else {
    hits.eye_inside = value_of(list, segments, walk);
  }
  const LaneMask arrived = walk_to_change(list, segments, hits.eye_inside, leave, walk);
  take_hits(walk, arrived, hits);
  hits.undecided = 0;
  if (arrived == 0) return;
  const LaneMask unclear =
      subject.boundary == Boundary::kBehind
          ? arrived
          : show_crossings(frame, rays, list, subject, segments, walk, arrived, hits).unclear;
  resolve_coincidences(frame, rays, unclear, list, subject, leave, walk, segments, workspace, hits);
}

void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceSubject& subject, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits) {
  const Wide d;
  ListSegments segments(frame, rays, list, subject, workspace);
  Walk walk = walk_from(range.enter, lanes);
  hits.eye_inside = eye_inside & known;
  if ((lanes & ~known) != 0) hits.eye_inside |= value_of(list, segments, walk) & ~known;
  const LaneMask arrived = walk_to_change(list, segments, hits.eye_inside, range.leave, walk);
  take_hits(walk, arrived, hits);
  hits.undecided = subject.boundary == Boundary::kBehind ? arrived : arrived & ~walk.moved;
  const LaneMask left = arrived & ~hits.undecided;
  if (left == 0) return;
  const Crossings crossings =
      show_crossings(frame, rays, list, subject, segments, walk, left, hits);
  hits.undecided |= crossings.unclear;
  // What may be together with the hit must lie where the list is valid.
  const auto thinnest2 = hn::Set(d, subject.thinnest_piece * subject.thinnest_piece);
  for (int c = 0; c < kChunks; ++c) {
    const WideV facing = crossings.facing.chunk[c];
    const auto valid2 = hn::Mul(hn::Set(d, range.margin * range.margin),
                                hn::Load(d, rays.inverse_length2 + first_lane(c)));
    const auto thickness2 = hn::Mul(hn::Mul(facing, facing), valid2);
    hits.undecided |= bits_of(hn::Not(hn::Ge(thickness2, thinnest2)), c) & left;
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

/// OpenSCAD's light: 0.2 + |n · light| (frontend/OPENSCAD.md, "Light and colours").
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

/// Lanes of `lanes` that show the same literal as the lowest of them.
HWY_INLINE LaneMask lanes_of_first(const PacketHits& hits, LaneMask lanes) {
  const uint32_t index = hits.index[std::countr_zero(lanes)];
  LaneMask same = 0;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    same |= LaneMask{hits.index[lane] == index} << lane;
  }
  return same & lanes;
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
  PacketV colors_of[3];  // of the faces, by channel
  for (PacketV& channel : colors_of) {
    for (int c = 0; c < kChunks; ++c) channel.chunk[c] = hn::Zero(d);
  }
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
      const WideM own = mask_of(same, c);
      for (int channel = 0; channel < 3; ++channel) {
        WideV& color = colors_of[channel].chunk[c];
        color = hn::IfThenElse(own, hn::Set(d, base[channel]), color);
      }
    }
  }
  if (settings.shading == Shading::kPhong) return;
  for (int c = 0; c < kChunks; ++c) {
    const WideV shade = openscad_shade(settings, hits, c);
    for (int channel = 0; channel < 3; ++channel) {
      const WideV value = hn::Mul(colors_of[channel].chunk[c], shade);
      hn::Store(hn::Min(value, hn::Set(d, 255.0)), d, colors.rgb[channel] + first_lane(c));
    }
  }
}

void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels) {
  const Wide d;
  const hn::Rebind<int32_t, Wide> integers;
  alignas(64) int32_t rgb[kPacketRays];  // from the lowest byte on
  for (int c = 0; c < kChunks; ++c) {
    const WideM own = mask_of(lanes, c);
    const auto channel = [&](size_t i) {
      const WideV value = hn::Load(d, colors.rgb[i] + first_lane(c));
      const WideV chosen = hn::IfThenElse(own, value, hn::Set(d, others[i]));
      return hn::DemoteTo(integers, hn::Add(chosen, hn::Set(d, 0.5)));
    };
    const auto green_blue = hn::Or(hn::ShiftLeft<8>(channel(1)), hn::ShiftLeft<16>(channel(2)));
    hn::Store(hn::Or(channel(0), green_blue), integers, rgb + first_lane(c));
  }
  for (size_t lane = 0; lane < kPacketRays; ++lane) {
    const uint32_t bits = static_cast<uint32_t>(rgb[lane]);
    pixels.rgb[lane] = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8),
                        static_cast<uint8_t>(bits >> 16)};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(make_rays);
CSGCORE_SIMD_EXPORT(make_four_rays);
CSGCORE_SIMD_EXPORT(make_block_rays);
CSGCORE_SIMD_EXPORT(intersect);
CSGCORE_SIMD_EXPORT(intersect_four);
CSGCORE_SIMD_EXPORT(find_entry_normals);
CSGCORE_SIMD_EXPORT(find_reached);
CSGCORE_SIMD_EXPORT(find_apart);
CSGCORE_SIMD_EXPORT(trace_packet);
CSGCORE_SIMD_EXPORT(trace_packet_in_range);
CSGCORE_SIMD_EXPORT(shade_packet);
CSGCORE_SIMD_EXPORT(round_colors);
CSGCORE_SIMD_EXPORT(invert_directions);
CSGCORE_SIMD_EXPORT(split_range);

void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  CSGCORE_SIMD(make_rays)(frame, laterals, rays);
}

void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  CSGCORE_SIMD(make_four_rays)(frame, laterals, rays);
}

void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays) {
  CSGCORE_SIMD(make_block_rays)(frame, x, y, rays);
}

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  CSGCORE_SIMD(intersect)(frame, rays, primitive, segments);
}

void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments) {
  CSGCORE_SIMD(intersect_four)(frame, rays, primitive, segments);
}

void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]) {
  CSGCORE_SIMD(find_entry_normals)(frame, rays, primitive, segments, normals);
}

void find_reached(const Extent* screen, const ScreenOutline* outlines,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below) {
  CSGCORE_SIMD(find_reached)(screen, outlines, primitives, x, y, above, below);
}

LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance) {
  return CSGCORE_SIMD(find_apart)(frame, rays, primitive, t, distance);
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

void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels) {
  CSGCORE_SIMD(round_colors)(colors, lanes, others, pixels);
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
