// Coincidence resolution for single rays (NUMERICS.md, "Coincidences"). Included once per
// instruction set.
#if defined(CSGCORE_RESOLVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_RESOLVE_INL_HPP
#undef CSGCORE_RESOLVE_INL_HPP
#else
#define CSGCORE_RESOLVE_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "packets/list_segments-inl.hpp"
#include "tree/list_expression.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

using Event = PacketWorkspace::Event;

/// Finds the crossing that a ray shows, by the letter of the definition. A boundary is a crossing
/// at which the solid's value changes. Two crossings coincide if they lie less than the tolerance
/// apart, measured along the normal of the surface that the ray meets more squarely. A coincidence
/// is a maximal run of boundaries each of which coincides with the next.
class RayResolver {
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

 public:
  /// The segments of all of the list's primitives must be computed for the lane.
  RayResolver(const FrameRays& frame, const RayPacket& packet, uint32_t lane,
              const TraceList& trace, const TraceParameters& parameters,
              ListSegments& list_segments, PacketWorkspace& workspace)
      : frame_(frame),
        direction_(load3(Single(), packet.direction, lane)),
        length_(std::sqrt(1.0 / packet.inverse_length2[lane])),
        lane_(lane),
        trace_(trace),
        parameters_(parameters),
        events_(workspace.events),
        changed_(workspace.changed),
        inside_(workspace.inside),
        repeats_(workspace.repeats),
        order_(workspace.order),
        is_first_(workspace.is_first),
        has_changed_(workspace.has_changed),
        operands_(workspace.operands),
        expression_(workspace.expression),
        list_segments_(list_segments),
        segments_(workspace.segments) {}

  /// Returns the crossing that the ray shows, if any. No boundary may lie before t; `value` is the
  /// solid's value at the eye.
  std::optional<Event> resolve(double t, bool value) {
    collect();
    const auto at_t = std::lower_bound(events_.begin(), events_.end(), t,
                                       [](const Event& event, double at) { return event.t < at; });
    pass_until(static_cast<size_t>(at_t - events_.begin()));
    int turns_left = parameters_.boundary == Boundary::kBehind ? 2 : 1;
    size_t begin = 0;
    for (size_t first = next_boundary(value); first < events_.size();) {
      const Coincidence coincidence = coincidence_of(begin, first, value);
      if (coincidence.turns && --turns_left == 0) return shown_of(coincidence, value);
      if (coincidence.turns) value = !value;
      begin = coincidence.last + 1;
      first = coincidence.end;
    }
    return std::nullopt;
  }

 private:
  /// A coincidence: a run of boundaries in events_[first] to events_[last]. The boundary before it
  /// has an index below `begin`, and the one after it has the index `end`.
  struct Coincidence {
    size_t begin, first, last, end;
    bool turns;  // the value after it differs from that before it
  };

  const CellList& list() const { return *trace_.list; }
  uint32_t primitive_of(const Event& event) const {
    return list().primitive[event.index] & kPrimitiveBits;
  }

  /// Collects the crossings beyond the eye, in order. A primitive with several tests is crossed
  /// once, by the first of them.
  void collect() {
    find_repeats();
    events_.clear();
    inside_.resize(list().count());
    for (uint32_t i = 0; i < list().count(); ++i) {
      inside_[i] = 0;
      if (list_segments_.has_windows(i)) {
        for (const RaySegment& segment : list_segments_.all_segments(i, lane_)) {
          collect(i, segment.start, segment.end, false, false);
        }
        continue;
      }
      const PacketSegments& segments = segments_[i];
      collect(i, segments.start[lane_], segments.end[lane_],
              (segments.start_on_cap >> lane_ & 1) != 0, (segments.end_on_cap >> lane_ & 1) != 0);
    }
    std::sort(events_.begin(), events_.end(), [&](const Event& a, const Event& b) {
      return a.t != b.t ? a.t < b.t : primitive_of(a) < primitive_of(b);
    });
    passed_ = 0;
  }

  /// Collects the ends of a segment.
  void collect(uint32_t index, double start, double end, bool start_on_cap, bool end_on_cap) {
    if (start <= frame_.first_t && end > frame_.first_t) inside_[index] = 1;
    if (!(start < end) || !is_first_[index]) return;
    if (start > frame_.first_t) events_.push_back({start, index, false, start_on_cap});
    if (end > frame_.first_t) events_.push_back({end, index, true, end_on_cap});
  }

  /// Finds, for each test, the next test of the same primitive.
  void find_repeats() {
    const uint32_t count = list().count();
    repeats_.assign(count, kNone);
    is_first_.assign(count, 1);
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    const auto primitive = [&](uint32_t index) { return list().primitive[index] & kPrimitiveBits; };
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return primitive(a) != primitive(b) ? primitive(a) < primitive(b) : a < b;
    });
    for (uint32_t i = 1; i < count; ++i) {
      if (primitive(order_[i]) != primitive(order_[i - 1])) continue;
      repeats_[order_[i - 1]] = order_[i];
      is_first_[order_[i]] = 0;
    }
  }

  // inside_ belongs to a point after the first passed_ crossings.
  void flip(uint32_t index) {
    for (; index != kNone; index = repeats_[index]) inside_[index] = !inside_[index];
  }
  void pass_until(size_t count) {
    while (passed_ < count) flip(events_[passed_++].index);
    while (passed_ > count) flip(events_[--passed_].index);
  }

  bool holds() const {
    uint32_t number = list().root;
    while (number >= CellList::kFirst) {
      const uint32_t i = number - CellList::kFirst;
      number = inside_[i] ? list().if_inside[i] : list().if_outside[i];
    }
    return number == CellList::kTrue;
  }

  /// Passes crossings up to the first one that changes the value, which is `value` now. Returns the
  /// index of that crossing.
  size_t next_boundary(bool value) {
    while (passed_ < events_.size()) {
      flip(events_[passed_++].index);
      if (holds() != value) return passed_ - 1;
    }
    return events_.size();
  }

  /// Returns the coincidence that begins with `first`, which has just been passed. `value` is the
  /// value before it.
  Coincidence coincidence_of(size_t begin, size_t first, bool value) {
    Coincidence coincidence{begin, first, first, events_.size(), true};
    for (;;) {
      coincidence.end = next_boundary(value == !coincidence.turns);
      if (coincidence.end == events_.size() ||
          !together(events_[coincidence.last], events_[coincidence.end])) {
        return coincidence;
      }
      coincidence.last = coincidence.end;
      coincidence.turns = !coincidence.turns;
    }
  }

  /// Returns |n·d| at the crossing: thickness per unit of t.
  double facing(const Event& event) const {
    const Single d;
    const Vec3 normal = list_segments_.normal_at(event.index, lane_, event.t, event.on_cap);
    return std::abs(hn::GetLane(dot(d, broadcast(d, normal), direction_)));
  }

  bool together(const Event& a, const Event& b) const {
    const double gap = std::abs(b.t - a.t);
    if (gap * length_ < parameters_.thickness_tolerance) return true;  // since |n·d| ≤ |d|
    return gap * std::max(facing(a), facing(b)) < parameters_.thickness_tolerance;
  }

  /// Collects the crossings by which a coincidence changes the primitives: its own, and those that
  /// coincide with its first or last boundary, which only rounding may have kept from being
  /// boundaries. They are in the order of the primitives. Leaves inside_ at a point after all of
  /// them.
  void collect_changes(const Coincidence& coincidence) {
    const auto place = [&](size_t i) { return events_.begin() + static_cast<long>(i); };
    changed_.assign(place(coincidence.first), place(coincidence.last + 1));
    const Event& first = events_[coincidence.first];
    const double before = parameters_.thickness_tolerance / facing(first);
    for (size_t i = coincidence.first;
         i-- > coincidence.begin && first.t - events_[i].t < before;) {
      if (together(first, events_[i])) changed_.push_back(events_[i]);
    }
    const Event& last = events_[coincidence.last];
    const double after = parameters_.thickness_tolerance / facing(last);
    size_t end = coincidence.last + 1;
    for (size_t i = end; i < coincidence.end && events_[i].t - last.t < after; ++i) {
      if (!together(last, events_[i])) continue;
      changed_.push_back(events_[i]);
      end = i + 1;
    }
    pass_until(end);
    drop_what_came_back();
  }

  /// Keeps the first crossing of each primitive that is crossed an odd number of times, and none of
  /// others.
  void drop_what_came_back() {
    std::sort(changed_.begin(), changed_.end(), [&](const Event& a, const Event& b) {
      const uint32_t primitives[] = {primitive_of(a), primitive_of(b)};
      if (primitives[0] != primitives[1]) return primitives[0] < primitives[1];
      return a.index != b.index ? a.index < b.index : a.t < b.t;
    });
    size_t kept = 0;
    for (size_t begin = 0, end = 0; begin < changed_.size(); begin = end) {
      while (end < changed_.size() && changed_[end].index == changed_[begin].index) ++end;
      if ((end - begin) % 2 == 1) changed_[kept++] = changed_[begin];
    }
    changed_.resize(kept);
  }

  /// Returns whether the crossing makes the test's operand true or, if `value` is true, false.
  bool turns(const Event& event, bool value) const {
    const bool complement = (list().primitive[event.index] & CellList::kComplementBit) != 0;
    return (event.at_end == complement) != value;
  }

  /// Returns the event with the test by which its primitive turns the value: a primitive may be
  /// both added and subtracted.
  Event as_turning(Event event, bool value) const {
    const Event first = event;
    for (; event.index != kNone; event.index = repeats_[event.index]) {
      if (turns(event, value)) return event;
    }
    return first;
  }

  /// Returns the primitive by which the coincidence turns the value, or another state (`turning` in
  /// list_expression.hpp).
  int32_t turning_primitive(bool value) {
    using Step = ListExpression::Step;
    has_changed_.assign(list().count(), 0);
    for (const Event& event : changed_) {
      for (uint32_t i = event.index; i != kNone; i = repeats_[i]) has_changed_[i] = 1;
    }
    expression_.parse(list());
    operands_.clear();
    uint32_t index = 0;
    for (const Step step : expression_.steps()) {
      if (step == Step::kTest) {
        const uint32_t entry = list().primitive[index];
        const bool is_negated = ((entry & CellList::kComplementBit) != 0) != value;
        const bool behind = (inside_[index] != 0) != is_negated;
        const bool before = behind != (has_changed_[index] != 0);
        operands_.push_back(turning::state_of(before, behind, entry & kPrimitiveBits));
        ++index;
        continue;
      }
      const int32_t last = operands_.back();
      operands_.pop_back();
      int32_t& other = operands_.back();
      const bool is_union = (step == Step::kUnion) != value;
      other = is_union ? turning::union_of(other, last) : turning::intersection_of(other, last);
    }
    return operands_.size() == 1 ? operands_.back() : turning::kFails;
  }

  /// Returns the crossing that is shown of a coincidence which turns the value from `value`.
  Event shown_of(const Coincidence& coincidence, bool value) {
    collect_changes(coincidence);
    const int32_t primitive = turning_primitive(value);
    if (turning::is_turned(primitive)) {
      for (const Event& event : changed_) {
        if (primitive_of(event) == static_cast<uint32_t>(primitive)) {
          return as_turning(event, value);
        }
      }
    }
    return as_turning(events_[coincidence.first], value);
  }

  const FrameRays& frame_;
  const Lanes3<Single> direction_;
  const double length_;
  const uint32_t lane_;
  const TraceList& trace_;
  const TraceParameters& parameters_;
  std::vector<Event>& events_;   // in order of t
  std::vector<Event>& changed_;  // see collect_changes()
  std::vector<uint8_t>& inside_;
  std::vector<uint32_t>& repeats_;
  std::vector<uint32_t>& order_;
  std::vector<uint8_t>& is_first_;
  std::vector<uint8_t>& has_changed_;
  std::vector<int32_t>& operands_;
  ListExpression& expression_;
  ListSegments& list_segments_;
  const std::vector<PacketSegments>& segments_;
  size_t passed_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
