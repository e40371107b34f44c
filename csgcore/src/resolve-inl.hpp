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
  /// `t`: the ray's value is that at the eye up to there, but for what lies so close before it that
  /// it is taken together with what lies there.
  std::optional<Shown> resolve(double t) {
    collect(t);
    int changes_left = subject_.boundary == Boundary::kBehind ? 2 : 1;
    bool value = subject_.eye_inside;
    while (next_cluster()) {
      for (const Event& event : workspace_.cluster) {
        workspace_.after[event.index] = !event.at_end;
      }
      if (holds(workspace_.after) != value) {
        if (--changes_left == 0) {
          const Event event = shown_of(workspace_.cluster, value);
          return Shown{event, is_on_cap(event)};
        }
        value = !value;
      }
      for (const Event& event : workspace_.cluster) {
        workspace_.before[event.index] = !event.at_end;
      }
    }
    return std::nullopt;
  }

 private:
  const CellList& list() const { return *trace_.list; }

  static bool is_earlier(const Event& a, const Event& b) { return a.t < b.t; }
  static bool is_later(const Event& a, const Event& b) { return a.t > b.t; }

  /// Only the crossings next to where the walk stands are needed in order: hundreds may lie
  /// elsewhere.
  void collect(double t) {
    std::vector<Event>& earlier = workspace_.earlier;
    std::vector<Event>& later = workspace_.later;
    earlier.clear();
    later.clear();
    const auto add = [&](const Event& event) {
      if (event.t > frame_.first_t) (event.t < t ? earlier : later).push_back(event);
    };
    for (uint32_t i = 0; i < list().count(); ++i) {
      const double start = workspace_.segments[i].start[lane_];
      const double end = workspace_.segments[i].end[lane_];
      if (!(start < end)) continue;
      add({start, i, false});
      add({end, i, true});
    }
    std::make_heap(earlier.begin(), earlier.end(), is_earlier);
    std::make_heap(later.begin(), later.end(), is_later);
    find_first_cluster();
    const double first_t = workspace_.cluster.empty() ? t : workspace_.cluster.front().t;
    workspace_.before.resize(list().count());
    for (uint32_t i = 0; i < list().count(); ++i) {
      const PacketSegments& segments = workspace_.segments[i];
      workspace_.before[i] = segments.start[lane_] < first_t && segments.end[lane_] >= first_t;
    }
    workspace_.after = workspace_.before;
  }

  /// What lies before t and is taken together with what lies at it, the earliest first.
  void find_first_cluster() {
    std::vector<Event>& cluster = workspace_.cluster;
    std::vector<Event>& earlier = workspace_.earlier;
    cluster.clear();
    if (workspace_.later.empty()) return;
    cluster.push_back(workspace_.later.front());
    std::pop_heap(workspace_.later.begin(), workspace_.later.end(), is_later);
    workspace_.later.pop_back();
    while (!earlier.empty() && together(earlier.front(), cluster.back())) {
      cluster.push_back(earlier.front());
      std::pop_heap(earlier.begin(), earlier.end(), is_earlier);
      earlier.pop_back();
    }
    std::reverse(cluster.begin(), cluster.end());
    is_first_ = true;
  }

  /// The maximal run of crossings each of which is taken together with the next.
  bool next_cluster() {
    std::vector<Event>& cluster = workspace_.cluster;
    std::vector<Event>& later = workspace_.later;
    if (!is_first_) cluster.clear();
    is_first_ = false;
    while (!later.empty() && (cluster.empty() || together(cluster.back(), later.front()))) {
      cluster.push_back(later.front());
      std::pop_heap(later.begin(), later.end(), is_later);
      later.pop_back();
    }
    return !cluster.empty();
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
  bool is_first_ = false;  // the cluster is the first one, begun by what lies before
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
