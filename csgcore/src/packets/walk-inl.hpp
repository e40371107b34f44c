// Walks a packet along its rays from crossing to crossing until the solid's value changes. Each
// lane has a current t. Included once per instruction set.
#if defined(CSGCORE_WALK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_WALK_INL_HPP
#undef CSGCORE_WALK_INL_HPP
#else
#define CSGCORE_WALK_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "packets/list_segments-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// The state of a packet's walk.
struct Walk {
  PacketV t;
  LaneMask live = 0;
  LaneMask moved = 0;  // lanes that have moved from where they began to a crossing
};

/// The list's value at the lanes' t. If it is the value `before`, it stays the same at least up to
/// next_t.
struct Evaluation {
  LaneMask value = 0;
  PacketV next_t;
};

/// Returns the lanes with v ≥ least.
HWY_INLINE LaneMask lanes_from(const PacketV& v, double least) {
  const Wide d;
  LaneMask result = 0;
  for (int c = 0; c < kChunks; ++c) result |= bits_of(hn::Ge(v.chunk[c], hn::Set(d, least)), c);
  return result;
}

/// Returns the largest value of any of the lanes; −∞ without lanes.
HWY_INLINE double furthest_of(const PacketV& v, LaneMask lanes) {
  const Wide d;
  WideV furthest = hn::Set(d, -kInfinity);
  for (int c = 0; c < kChunks; ++c) {
    furthest = hn::Max(furthest, hn::IfThenElse(mask_of(lanes, c), v.chunk[c], furthest));
  }
  return hn::GetLane(hn::MaxOfLanes(d, furthest));
}

/// Lowers `next_t` of `lanes` to `ahead` where that is greater than t.
HWY_INLINE void stop_at(const WideV (&ahead)[kChunks], LaneMask lanes, const PacketV& t,
                        PacketV& next_t) {
  for (int c = 0; c < kChunks; ++c) {
    const WideM stops = hn::And(mask_of(lanes, c), hn::Lt(t.chunk[c], ahead[c]));
    const WideV sooner = hn::Min(next_t.chunk[c], ahead[c]);
    next_t.chunk[c] = hn::IfThenElse(stops, sooner, next_t.chunk[c]);
  }
}

/// Evaluates the list by short circuit, for all lanes at once: the lanes whose program counter is
/// the current test are tested and jump. Only tests that decide are visited, and a primitive is not
/// intersected if no lane can have reached it at its t. `before` is the lanes' value up to here.
/// For lanes whose value is another one, next_t is not found. A jump to the constant that equals
/// `before` cannot change the value, so that the crossing which causes it is not looked for.
HWY_INLINE void evaluate(const TraceList& trace, ListSegments& segments, const Walk& walk,
                         LaneMask before, Evaluation& result) {
  const Wide d;
  const CellList& list = *trace.list;
  const uint32_t* const if_inside = list.if_inside.data();
  const uint32_t* const if_outside = list.if_outside.data();
  LaneMask* const program_counter = segments.program_counter();
  program_counter[CellList::kFalse] = program_counter[CellList::kTrue] = 0;
  program_counter[list.root] = walk.live;
  const LaneMask other[] = {before, ~before};  // lanes whose value before is not false, not true
  const auto changing = [&](uint32_t number) {
    return number < CellList::kFirst ? other[number] : kAllLanes;
  };
  for (int c = 0; c < kChunks; ++c) result.next_t.chunk[c] = hn::Set(d, kInfinity);
  const double furthest_t = furthest_of(walk.t, walk.live);
  for (uint32_t index = list.count(); index-- > 0;) {
    const LaneMask program_counter_here = program_counter[index + CellList::kFirst];
    if (program_counter_here == 0) continue;
    program_counter[index + CellList::kFirst] = 0;
    LaneMask& outer = program_counter[if_outside[index]];
    LaneMask active = program_counter_here & segments.reached(index);
    outer |= program_counter_here & ~active;
    if (active == 0) continue;
    const LaneMask may_enter = active & changing(if_inside[index]);
    WideV ahead[kChunks];
    if (!segments.are_known(index, active)) {
      const double nearest_t = trace.nearest_t[index];
      if (furthest_t < nearest_t) {
        // The lanes are still outside, until nearest_t at the earliest.
        for (int c = 0; c < kChunks; ++c) ahead[c] = hn::Set(d, nearest_t);
        if (may_enter != 0) stop_at(ahead, may_enter, walk.t, result.next_t);
        outer |= active;
        continue;
      }
      if (may_enter == 0) {
        const LaneMask apart = segments.apart(index, walk.t, active);
        outer |= apart;
        active &= ~apart;
        if (active == 0) continue;
      }
    }
    const PacketSegments& segment = segments.at(index, active, walk.t);
    const LaneMask may_leave = active & changing(if_outside[index]);
    LaneMask inside = 0;
    for (int c = 0; c < kChunks; ++c) {
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      const WideV end = hn::Load(d, segment.end + first_lane(c));
      const WideV t = walk.t.chunk[c];
      ahead[c] = start;
      WideV& next_t = result.next_t.chunk[c];
      const WideM is_inside = hn::AndNot(hn::Lt(t, start), hn::Lt(t, end));
      const WideM leaves = hn::And(mask_of(may_leave, c), is_inside);
      next_t = hn::IfThenElse(leaves, hn::Min(next_t, end), next_t);
      inside |= bits_of(is_inside, c);
    }
    if (may_enter != 0) stop_at(ahead, may_enter, walk.t, result.next_t);
    program_counter[if_inside[index]] |= active & inside;
    outer |= active & ~inside;
  }
  result.value = program_counter[CellList::kTrue];
}

/// Moves lanes that start outside of all primitives to the first crossing that may change the
/// list's value. Lanes without such a crossing are no longer live. Outside of all primitives,
/// evaluation visits only the tests on the chain of if_outside from the root on, so that the first
/// crossing of one of these is the first that may change the value. Returns the value up to the
/// crossing.
HWY_INLINE bool walk_to_first_crossing(const TraceList& trace, ListSegments& segments, Walk& walk) {
  const Wide d;
  const CellList& list = *trace.list;
  for (int c = 0; c < kChunks; ++c) walk.t.chunk[c] = hn::Set(d, kInfinity);
  uint32_t number = list.root;
  while (number >= CellList::kFirst) {
    const uint32_t index = number - CellList::kFirst;
    number = list.if_outside[index];
    const LaneMask lanes = walk.live & segments.reached(index);
    if ((lanes_from(walk.t, trace.nearest_t[index]) & lanes) == 0) continue;
    const PacketSegments& segment = segments.compute(index, lanes);
    for (int c = 0; c < kChunks; ++c) {
      const WideV start = hn::Load(d, segment.start + first_lane(c));
      walk.t.chunk[c] = hn::Min(start, walk.t.chunk[c]);
    }
  }
  walk.live &= ~lanes_from(walk.t, kInfinity);
  walk.moved = walk.live;
  return number == CellList::kTrue;
}

/// The lanes of a packet that lie before the start of a segment, and within the segment.
struct Sides {
  LaneMask before, within;
};
HWY_INLINE Sides sides_of(const PacketSegments& segment, const PacketV& t) {
  const Wide d;
  LaneMask before_start = 0;
  LaneMask before_end = 0;
  for (int c = 0; c < kChunks; ++c) {
    const auto is_before = [&](const double* ends) {
      return bits_of(hn::Lt(t.chunk[c], hn::Load(d, ends + first_lane(c))), c);
    };
    before_start |= is_before(segment.start);
    before_end |= is_before(segment.end);
  }
  return {before_start, before_end & ~before_start};
}

/// Moves lanes to `to`, unless that lies beyond `leave`. Returns the lanes that were moved. Raises
/// `furthest_t` to the largest t of these.
HWY_INLINE LaneMask move_lanes(LaneMask lanes, const double* to, const double* leave, Walk& walk,
                               double& furthest_t) {
  const Wide d;
  LaneMask arrived = 0;
  WideV furthest = hn::Set(d, furthest_t);
  for (int c = 0; c < kChunks; ++c) {
    const WideV next = hn::Load(d, to + first_lane(c));
    const WideM further =
        hn::And(mask_of(lanes, c), hn::Le(next, hn::Load(d, leave + first_lane(c))));
    arrived |= bits_of(further, c);
    walk.t.chunk[c] = hn::IfThenElse(further, next, walk.t.chunk[c]);
    furthest = hn::IfThenElse(further, hn::Max(furthest, next), furthest);
  }
  furthest_t = hn::GetLane(hn::MaxOfLanes(d, furthest));
  walk.moved |= arrived;
  return arrived;
}

/// Walks all lanes of `walk.live`, whose value is false, until it is true, but not beyond `leave`.
/// Returns the lanes that got there. Precondition: segments.all_must_hold(). A test that fails
/// moves a lane to the next t at which it holds. The first t at which all tests hold is the least
/// one that no test moves any further (the fixed point of an intersection).
HWY_INLINE LaneMask walk_to_all(const TraceList& trace, ListSegments& segments, const double* leave,
                                Walk& walk) {
  const CellList& list = *trace.list;
  const uint32_t* const if_inside = list.if_inside.data();
  double furthest_t = furthest_of(walk.t, walk.live);
  LaneMask unsettled = walk.live;  // lanes that have moved since they passed some test
  uint32_t last_moved = 0;         // the last test that moved a lane
  bool is_first_round = true;
  const auto end = [&](LaneMask lanes) {
    walk.live &= ~lanes;
    unsettled &= ~lanes;
  };
  while (unsettled != 0) {
    LaneMask moved = 0;
    for (uint32_t index = list.count(); index-- > 0;) {
      const bool must_be_outside = if_inside[index] == CellList::kFalse;
      LaneMask active = unsettled & segments.reached(index);
      if (!must_be_outside) {
        end(unsettled & ~active);
      } else if (active != 0 && !segments.are_known(index, active)) {
        // Lanes before the primitive, or separated from it, are outside.
        const bool is_ahead = furthest_t < trace.nearest_t[index];
        active &= is_ahead ? 0 : ~segments.apart(index, walk.t, active);
      }
      LaneMask moves = 0;
      if (active != 0) {
        const PacketSegments& segment = segments.at(index, active, walk.t);
        const Sides sides = sides_of(segment, walk.t);
        moves = active & (must_be_outside ? sides.within : sides.before);
        if (!must_be_outside) end(active & ~sides.before & ~sides.within);
        if (moves != 0) {
          const double* const to = must_be_outside ? segment.end : segment.start;
          const LaneMask goes_on = move_lanes(moves, to, leave, walk, furthest_t);
          end(moves & ~goes_on);
          moved |= goes_on;
          segments.forget_apart(goes_on);
          last_moved = index;
        }
      }
      // No lane has moved since this test moved one, and all tests have been passed since.
      if (moves == 0 && moved == 0 && index == last_moved && !is_first_round) break;
    }
    is_first_round = false;
    unsettled &= moved;
  }
  return walk.live;
}

/// Walks all lanes of `walk.live` until their value is not that in `before`, but not beyond
/// `leave`. Returns the lanes that got there; walk.t has their t.
HWY_INLINE LaneMask walk_to_change(const TraceList& trace, ListSegments& segments, LaneMask before,
                                   const double* leave, Walk& walk) {
  if (segments.all_must_hold() && (before & walk.live) == 0) {
    return walk_to_all(trace, segments, leave, walk);
  }
  const Wide d;
  LaneMask changed = 0;
  Evaluation evaluation;
  while (walk.live != 0) {
    evaluate(trace, segments, walk, before, evaluation);
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
    segments.forget_apart(goes_on);
  }
  return changed;
}

/// Returns the value of all lanes at their t.
HWY_INLINE LaneMask value_of(const TraceList& trace, ListSegments& segments, const Walk& walk) {
  Evaluation evaluation;
  evaluate(trace, segments, walk, 0, evaluation);
  return evaluation.value;
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
