// One ray on which crossings coincide: they are taken together (NUMERICS.md, "Clusters"). Included
// once per instruction set.
#if defined(CSGCORE_RESOLVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_RESOLVE_INL_HPP
#undef CSGCORE_RESOLVE_INL_HPP
#else
#define CSGCORE_RESOLVE_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "primitive-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

using Event = PacketWorkspace::Event;

class RayResolver {
 public:
  /// All of the list's segments are computed.
  RayResolver(const FrameRays& frame, const RayPacket& packet, uint32_t lane,
              const TraceList& trace, const TraceSubject& subject, PacketWorkspace& workspace)
      : frame_(frame),
        rays_(load_rays(Single(), packet, lane)),
        length_(std::sqrt(1.0 / packet.inverse_length2[lane])),
        lane_(lane),
        trace_(trace),
        subject_(subject),
        workspace_(workspace) {}

  /// The crossing that the ray shows, if any.
  struct Shown {
    Event event;
    bool on_cap;
  };
  std::optional<Shown> resolve() {
    collect();
    const std::span<const Event> events = workspace_.events;
    int changes_left = subject_.boundary == Boundary::kBehind ? 2 : 1;
    bool value = subject_.eye_inside;
    for (size_t first = 0; first < events.size();) {
      const size_t end = cluster_end(events, first);
      const auto cluster = events.subspan(first, end - first);
      workspace_.after = workspace_.before;
      for (const Event& event : cluster) workspace_.after[event.index] = !event.at_end;
      if (holds(workspace_.after) != value) {
        if (--changes_left == 0) {
          const Event event = shown_of(cluster, value);
          return Shown{event, is_on_cap(event)};
        }
        value = !value;
      }
      std::swap(workspace_.before, workspace_.after);
      first = end;
    }
    return std::nullopt;
  }

 private:
  const CellList& list() const { return *trace_.list; }

  /// The crossings before the eye's τ only leave their mark in `before`.
  void collect() {
    std::vector<Event>& events = workspace_.events;
    events.clear();
    workspace_.before.assign(list().count(), 0);
    for (uint32_t i = 0; i < list().count(); ++i) {
      const double start = workspace_.segments[i].start[lane_];
      const double end = workspace_.segments[i].end[lane_];
      if (!(start < end)) continue;
      if (start > frame_.first_t) events.push_back({start, i, false});
      if (end > frame_.first_t) events.push_back({end, i, true});
      workspace_.before[i] = start <= frame_.first_t && end > frame_.first_t;
    }
    std::sort(events.begin(), events.end(),
              [](const Event& a, const Event& b) { return a.t < b.t; });
  }

  bool is_on_cap(const Event& event) const {
    const PacketSegments& segments = workspace_.segments[event.index];
    return ((event.at_end ? segments.end_on_cap : segments.start_on_cap) >> lane_ & 1) != 0;
  }

  /// |n·d| there.
  double facing(const Event& event) const {
    const Single d;
    const CanonicalPrimitive& primitive =
        trace_.primitives[list().primitive[event.index] & kPrimitiveBits];
    const auto on_cap = hn::Eq(hn::Set(d, is_on_cap(event) ? 1.0 : 0.0), hn::Set(d, 1.0));
    const auto normal = normal_of(d, primitive, frame_.pivot, rays_, hn::Set(d, event.t), on_cap);
    return std::abs(hn::GetLane(dot(d, normal, rays_.direction)));
  }

  bool together(const Event& a, const Event& b) const {
    const double gap = b.t - a.t;
    if (gap * length_ < subject_.thinnest_piece) return true;  // |n·d| ≤ |d|
    return gap * std::max(facing(a), facing(b)) < subject_.thinnest_piece;
  }

  size_t cluster_end(std::span<const Event> events, size_t first) const {
    size_t end = first + 1;
    while (end < events.size() && together(events[end - 1], events[end])) ++end;
    return end;
  }

  bool holds(const std::vector<uint8_t>& inside) const {
    uint32_t number = list().root;
    while (number >= CellList::kFirst) {
      const uint32_t i = number - CellList::kFirst;
      number = inside[i] ? list().if_inside[i] : list().if_outside[i];
    }
    return number == CellList::kTrue;
  }

  /// Whether the value stays what it was before the cluster if only this primitive's change is
  /// undone.
  bool decides(uint32_t primitive, bool value) {
    // `before` serves as the working copy: its own content is needed in this primitive's places
    // only, where the two are each other's complement.
    std::vector<uint8_t>& after = workspace_.after;
    const auto flip = [&] {
      for (uint32_t i = 0; i < list().count(); ++i) {
        if ((list().primitive[i] & kPrimitiveBits) == primitive) after[i] = !after[i];
      }
    };
    flip();
    const bool result = holds(after) == value;
    flip();
    return result;
  }

  Event shown_of(std::span<const Event> cluster, bool value) {
    const Event* best = nullptr;
    uint32_t best_primitive = 0;
    int best_rank = 0;
    for (const Event& event : cluster) {
      if (workspace_.before[event.index] == workspace_.after[event.index]) continue;
      const uint32_t entry = list().primitive[event.index];
      const uint32_t primitive = entry & kPrimitiveBits;
      const bool complement = (entry & CellList::kComplementBit) != 0;
      const bool turns = (event.at_end == complement) != value;
      const int rank = decides(primitive, value) ? 2 : turns ? 1 : 0;
      if (!best || rank > best_rank || (rank == best_rank && primitive < best_primitive)) {
        best = &event;
        best_primitive = primitive;
        best_rank = rank;
      }
    }
    return *best;
  }

  const FrameRays& frame_;
  Rays<Single> rays_;
  double length_;
  uint32_t lane_;
  const TraceList& trace_;
  const TraceSubject& subject_;
  PacketWorkspace& workspace_;
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
