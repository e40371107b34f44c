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
    if (workspace.segments.size() < count) workspace.segments.resize(count);
    if (list.is_missed) {
      workspace.states.resize(count);
      for (uint32_t i = 0; i < count; ++i) {
        workspace.states[i] = list.is_missed[i] ? State::kMissed : State::kUnknown;
      }
    } else {
      workspace.states.assign(count, State::kUnknown);
    }
  }
  HWY_INLINE bool is_missed(uint32_t index) const {
    return workspace_.states[index] == State::kMissed;
  }
  /// Nothing is known of the primitive but that it lies further on than t.
  HWY_INLINE bool is_beyond(uint32_t index, double t) const {
    return workspace_.states[index] == State::kUnknown && list_.nearest_t[index] > t;
  }
  HWY_INLINE const PacketSegments& compute(uint32_t index) {
    PacketSegments& segments = workspace_.segments[index];
    if (workspace_.states[index] == State::kUnknown) {
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

 private:
  const FrameRays& frame_;
  const RayPacket& rays_;
  const TraceList& list_;
  PacketWorkspace& workspace_;
};

/// A crossing in a double: twice the literal's index, + 1 at the segment's end.
HWY_INLINE double event_code(uint32_t index, bool at_end) { return 2.0 * index + (at_end ? 1 : 0); }

/// Where the packet stands.
struct Walk {
  PacketV t;
  PacketV event;  // the crossing that lies there
  LaneMask live = 0;
};

/// The list's value at t, and the next crossing that may change it.
struct Evaluation {
  LaneMask value = 0;
  PacketV next_t, next_event;
};

HWY_INLINE double largest(const PacketV& v, LaneMask lanes) {
  const Wide d;
  WideV result = hn::Set(d, -kInfinity);
  for (int c = 0; c < kChunks; ++c) {
    result = hn::Max(result, hn::IfThenElse(mask_of(lanes, c), v.chunk[c], hn::Set(d, -kInfinity)));
  }
  return hn::GetLane(hn::MaxOfLanes(d, result));
}

/// Short-circuit evaluation of all lanes at once: each stands at one literal of the list, and those
/// that stand at the literal whose turn it is are tested and jump. Only literals that decide are
/// visited; what no lane can have reached at its t is not intersected.
HWY_INLINE void evaluate(const TraceList& trace, ListSegments& segments, const Walk& walk,
                         Evaluation& result) {
  const Wide d;
  const CellList& list = *trace.list;
  const double furthest = largest(walk.t, walk.live);
  PacketV position;
  const WideV nowhere = hn::Set(d, -1.0);
  for (int c = 0; c < kChunks; ++c) {
    position.chunk[c] = hn::IfThenElse(mask_of(walk.live, c), hn::Set(d, list.root), nowhere);
    result.next_t.chunk[c] = hn::Set(d, kInfinity);
    result.next_event.chunk[c] = nowhere;
  }
  for (uint32_t index = list.count(); index-- > 0;) {
    const WideV number = hn::Set(d, index + CellList::kFirst);
    const WideV inner = hn::Set(d, list.if_inside[index]);
    const WideV outer = hn::Set(d, list.if_outside[index]);
    if (segments.is_missed(index)) {
      for (int c = 0; c < kChunks; ++c) {
        const WideM active = hn::Eq(position.chunk[c], number);
        position.chunk[c] = hn::IfThenElse(active, outer, position.chunk[c]);
      }
      continue;
    }
    if (segments.is_beyond(index, furthest)) {
      // Outside as yet, until there at the earliest.
      const WideV nearest = hn::Set(d, trace.nearest_t[index]);
      const WideV event = hn::Set(d, event_code(index, false));
      for (int c = 0; c < kChunks; ++c) {
        const WideM active = hn::Eq(position.chunk[c], number);
        const WideM sooner = hn::And(active, hn::Lt(nearest, result.next_t.chunk[c]));
        result.next_t.chunk[c] = hn::IfThenElse(sooner, nearest, result.next_t.chunk[c]);
        result.next_event.chunk[c] = hn::IfThenElse(sooner, event, result.next_event.chunk[c]);
        position.chunk[c] = hn::IfThenElse(active, outer, position.chunk[c]);
      }
      continue;
    }
    const PacketSegments& segment = segments.compute(index);
    const WideV start_event = hn::Set(d, event_code(index, false));
    const WideV end_event = hn::Set(d, event_code(index, true));
    for (int c = 0; c < kChunks; ++c) {
      const WideM active = hn::Eq(position.chunk[c], number);
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      const WideV end = hn::Load(d, segment.end + first_lane(c));
      const WideV t = walk.t.chunk[c];
      const WideM ahead = hn::Lt(t, start);
      const WideM inside = hn::AndNot(ahead, hn::Lt(t, end));
      const WideV boundary = hn::IfThenElse(ahead, start, end);
      // The segment's end counts for lanes inside only: for lanes behind it, it is not > t.
      const WideM sooner =
          hn::And(hn::And(active, hn::Gt(boundary, t)), hn::Lt(boundary, result.next_t.chunk[c]));
      result.next_t.chunk[c] = hn::IfThenElse(sooner, boundary, result.next_t.chunk[c]);
      result.next_event.chunk[c] = hn::IfThenElse(
          sooner, hn::IfThenElse(inside, end_event, start_event), result.next_event.chunk[c]);
      position.chunk[c] =
          hn::IfThenElse(active, hn::IfThenElse(inside, inner, outer), position.chunk[c]);
    }
  }
  result.value = 0;
  const WideV is_true = hn::Set(d, double{CellList::kTrue});
  for (int c = 0; c < kChunks; ++c) {
    result.value |= bits_of(hn::Eq(position.chunk[c], is_true), c);
  }
}

/// Moves lanes that are outside of all primitives to the first crossing that may change the list's
/// value; lanes that meet none, or none before `leave`, are no longer live. What follows such a
/// crossing decides the value, whatever precedes it, since nothing is entered before. Returns the
/// value up to there.
HWY_INLINE bool walk_to_first_crossing(const TraceList& trace, ListSegments& segments, double leave,
                                       Walk& walk) {
  const Wide d;
  const CellList& list = *trace.list;
  PacketV next_t, next_event;
  for (int c = 0; c < kChunks; ++c) {
    next_t.chunk[c] = hn::Set(d, kInfinity);
    next_event.chunk[c] = hn::Set(d, -1.0);
  }
  double furthest = kInfinity;  // of the lanes' next_t
  uint32_t number = list.root;
  while (number >= CellList::kFirst) {
    const uint32_t index = number - CellList::kFirst;
    number = list.if_outside[index];
    if (segments.is_missed(index) || trace.nearest_t[index] > furthest) continue;
    const PacketSegments& segment = segments.compute(index);
    const WideV event = hn::Set(d, event_code(index, false));
    for (int c = 0; c < kChunks; ++c) {
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      const WideM sooner = hn::Lt(start, next_t.chunk[c]);
      next_t.chunk[c] = hn::Min(start, next_t.chunk[c]);
      next_event.chunk[c] = hn::IfThenElse(sooner, event, next_event.chunk[c]);
    }
    if (number >= CellList::kFirst) furthest = largest(next_t, walk.live);
  }
  const WideV limit = hn::Set(d, leave);
  LaneMask found = 0;
  for (int c = 0; c < kChunks; ++c) {
    found |= bits_of(hn::Le(next_t.chunk[c], limit), c);
    walk.t.chunk[c] = next_t.chunk[c];
    walk.event.chunk[c] = next_event.chunk[c];
  }
  walk.live &= found;
  return number == CellList::kTrue;
}

/// Walks all lanes of `walk.live` until their value is no longer that in `before`, no further than
/// `leave`; returns the lanes that got there, whose t and event are kept in the walk.
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
      walk.event.chunk[c] =
          hn::IfThenElse(further, evaluation.next_event.chunk[c], walk.event.chunk[c]);
    }
    walk.live &= goes_on;
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
