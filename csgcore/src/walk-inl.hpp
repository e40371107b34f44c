// Walks a packet along its rays from crossing to crossing until the solid's value changes. Included
// once per instruction set.
#if defined(CSGCORE_WALK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_WALK_INL_HPP
#undef CSGCORE_WALK_INL_HPP
#else
#define CSGCORE_WALK_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "primitive-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// The segments of a list's primitives, computed where first needed.
class ListSegments {
  using State = PacketWorkspace::State;

 public:
  ListSegments(const FrameRays& frame, const RayPacket& rays, const TraceList& list,
               PacketWorkspace& workspace)
      : frame_(frame), rays_(rays), list_(list), workspace_(workspace) {
    const uint32_t count = list.list->count();
    if (workspace.standing.size() < count + CellList::kFirst) {
      workspace.segments.resize(count);
      workspace.states.resize(count);
      workspace.standing.resize(count + CellList::kFirst, 0);
    }
    for (uint32_t i = 0; i < count; ++i) {
      const bool missed = list.is_missed && list.is_missed[i];
      workspace.states[i] = missed ? State::kMissed : State::kUnknown;
      // Of a large scene, they come from far away.
      if (!missed) prefetch_rays_part(primitive(i));
    }
  }
  HWY_INLINE bool is_missed(uint32_t index) const {
    return workspace_.states[index] == State::kMissed;
  }
  HWY_INLINE bool is_unknown(uint32_t index) const {
    return workspace_.states[index] == State::kUnknown;
  }
  HWY_INLINE const PacketSegments& compute(uint32_t index) {
    PacketSegments& segments = workspace_.segments[index];
    if (is_unknown(index)) {
      intersect_packet(frame_, rays_, primitive(index), segments);
      workspace_.states[index] = State::kComputed;
      if (!workspace_.was_computed.empty()) workspace_.was_computed[index] = 1;
      workspace_.intersections += kPacketRays;
    }
    return segments;
  }
  /// For who reads them all: what is missed has segments too.
  void compute_all() {
    for (uint32_t i = 0; i < list_.list->count(); ++i) {
      if (!is_missed(i)) {
        compute(i);
        continue;
      }
      std::fill_n(workspace_.segments[i].start, kPacketRays, kInfinity);
      std::fill_n(workspace_.segments[i].end, kPacketRays, -kInfinity);
    }
  }
  HWY_INLINE const CanonicalPrimitive& primitive(uint32_t index) const {
    return list_.primitives[list_.list->primitive[index] & kPrimitiveBits];
  }
  /// By a literal's number, or a constant: the lanes whose evaluation stands there. Between
  /// evaluations, none stand at literals.
  HWY_INLINE LaneMask* standing() { return workspace_.standing.data(); }

 private:
  const FrameRays& frame_;
  const RayPacket& rays_;
  const TraceList& list_;
  PacketWorkspace& workspace_;
};

/// Where the packet stands.
struct Walk {
  PacketV t;
  LaneMask live = 0;
  LaneMask moved = 0;  // lanes that no longer stand where they began, but at a crossing
};

/// The list's value at t, and how far it surely keeps it.
struct Evaluation {
  LaneMask value = 0;
  PacketV next_t;
};

/// Lanes whose value is at least as large.
HWY_INLINE LaneMask lanes_from(const PacketV& v, double least) {
  const Wide d;
  LaneMask result = 0;
  for (int c = 0; c < kChunks; ++c) result |= bits_of(hn::Ge(v.chunk[c], hn::Set(d, least)), c);
  return result;
}

/// Short-circuit evaluation of all lanes at once: those that stand at the literal whose turn it is
/// are tested and jump. Only literals that decide are visited; what no lane can have reached at its
/// t is not intersected.
HWY_INLINE void evaluate(const TraceList& trace, ListSegments& segments, const Walk& walk,
                         Evaluation& result) {
  const Wide d;
  const CellList& list = *trace.list;
  LaneMask* const standing = segments.standing();
  standing[CellList::kFalse] = standing[CellList::kTrue] = 0;
  standing[list.root] = walk.live;
  for (int c = 0; c < kChunks; ++c) result.next_t.chunk[c] = hn::Set(d, kInfinity);
  for (uint32_t index = list.count(); index-- > 0;) {
    const LaneMask active = standing[index + CellList::kFirst];
    if (active == 0) continue;
    standing[index + CellList::kFirst] = 0;
    LaneMask& outer = standing[list.if_outside[index]];
    if (segments.is_missed(index)) {
      outer |= active;
      continue;
    }
    const double nearest_t = trace.nearest_t[index];
    if (segments.is_unknown(index) && (lanes_from(walk.t, nearest_t) & active) == 0) {
      // Outside as yet, until there at the earliest.
      for (int c = 0; c < kChunks; ++c) {
        WideV& next_t = result.next_t.chunk[c];
        const WideV sooner = hn::Min(next_t, hn::Set(d, nearest_t));
        next_t = hn::IfThenElse(mask_of(active, c), sooner, next_t);
      }
      outer |= active;
      continue;
    }
    const PacketSegments& segment = segments.compute(index);
    LaneMask inside = 0;
    for (int c = 0; c < kChunks; ++c) {
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      const WideV end = hn::Load(d, segment.end + first_lane(c));
      const WideV t = walk.t.chunk[c];
      WideV& next_t = result.next_t.chunk[c];
      const WideM before_start = hn::Lt(t, start);
      const WideM before_end = hn::Lt(t, end);
      const WideV sooner = hn::Min(next_t, hn::IfThenElse(before_start, start, end));
      const WideM counts = hn::And(mask_of(active, c), hn::Or(before_start, before_end));
      next_t = hn::IfThenElse(counts, sooner, next_t);
      inside |= bits_of(hn::AndNot(before_start, before_end), c);
    }
    standing[list.if_inside[index]] |= active & inside;
    outer |= active & ~inside;
  }
  result.value = standing[CellList::kTrue];
}

/// Moves lanes that are outside of all primitives to the first crossing that may change the list's
/// value; lanes that meet none are no longer live. What follows such a crossing decides the value,
/// whatever precedes it, since nothing is entered before. Returns the value up to there.
HWY_INLINE bool walk_to_first_crossing(const TraceList& trace, ListSegments& segments, Walk& walk) {
  const Wide d;
  const CellList& list = *trace.list;
  for (int c = 0; c < kChunks; ++c) walk.t.chunk[c] = hn::Set(d, kInfinity);
  uint32_t number = list.root;
  while (number >= CellList::kFirst) {
    const uint32_t index = number - CellList::kFirst;
    number = list.if_outside[index];
    if (segments.is_missed(index)) continue;
    if ((lanes_from(walk.t, trace.nearest_t[index]) & walk.live) == 0) continue;
    const PacketSegments& segment = segments.compute(index);
    for (int c = 0; c < kChunks; ++c) {
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      walk.t.chunk[c] = hn::Min(start, walk.t.chunk[c]);
    }
  }
  walk.live &= ~lanes_from(walk.t, kInfinity);
  walk.moved = walk.live;
  return number == CellList::kTrue;
}

/// Walks all lanes of `walk.live` until their value is no longer that in `before`, no further than
/// `leave`; returns the lanes that got there, whose t is kept in the walk.
HWY_INLINE LaneMask walk_to_change(const TraceList& trace, ListSegments& segments, LaneMask before,
                                   const double* leave, Walk& walk) {
  const Wide d;
  LaneMask changed = 0;
  Evaluation evaluation;
  while (walk.live != 0) {
    evaluate(trace, segments, walk, evaluation);
    changed |= walk.live & (before ^ evaluation.value);
    walk.live &= ~changed;
    LaneMask goes_on = 0;
    for (int c = 0; c < kChunks; ++c) {
      const WideV limit = hn::Load(d, leave + first_lane(c));
      const WideV next = evaluation.next_t.chunk[c];
      const WideM further = hn::And(mask_of(walk.live, c), hn::Le(next, limit));
      goes_on |= bits_of(further, c);
      walk.t.chunk[c] = hn::IfThenElse(further, next, walk.t.chunk[c]);
    }
    walk.live &= goes_on;
    walk.moved |= goes_on;
  }
  return changed;
}

/// The value of all lanes where they stand.
HWY_INLINE LaneMask value_of(const TraceList& trace, ListSegments& segments, const Walk& walk) {
  Evaluation evaluation;
  evaluate(trace, segments, walk, evaluation);
  return evaluation.value;
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
