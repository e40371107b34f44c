// The segments of a list's primitives on the rays of a packet. Included once per instruction set.
#if defined(CSGCORE_LIST_SEGMENTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_LIST_SEGMENTS_INL_HPP
#undef CSGCORE_LIST_SEGMENTS_INL_HPP
#else
#define CSGCORE_LIST_SEGMENTS_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "packets/trace_list.hpp"
#include "primitives/apart-inl.hpp"
#include "primitives/kind_crossings-inl.hpp"
#include "primitives/primitive-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// A search looks for so many crossings of a ray with a primitive that is not convex: the first one
/// for the ends of one segment, and each further one for twice as many, but for all that are left
/// after kMostCrossings.
constexpr size_t kFirstCrossings = 2, kMostCrossings = 32;

/// The sheets of open meshes (NUMERICS.md, "Meshes"): their thickness in thickness tolerances, and
/// the least cosine at which it is measured along the normal.
constexpr double kSheetThickness = 4;
constexpr double kSheetCosine = 0x1p-10;

/// Returns all lanes of the groups of four that hold any of the given lanes. Lanes are intersected
/// in these groups, so that it does not depend on the vectors' width which segments are known.
HWY_INLINE LaneMask whole_fours(LaneMask lanes) {
  lanes |= lanes >> 1;
  lanes |= lanes >> 2;
  return (lanes & 0x11111111u) * 0xFu;
}

/// The segments of a list's primitives, which are computed when first needed. Once a primitive's
/// segment is known for any lane, the segments of other lanes are either right or empty.
///
/// A ray meets a convex primitive in one segment. Of another primitive, PacketSegments holds one
/// segment at a time, the lane's *window*, which moves along its SegmentList.
class ListSegments {
 public:
  ListSegments(const FrameRays& frame, const RayPacket& rays, const TraceList& list,
               const TraceParameters& parameters, PacketWorkspace& workspace)
      : frame_(frame),
        rays_(rays),
        list_(list),
        apart_(kApart * parameters.thickness_tolerance),
        sheet_thickness_(kSheetThickness * parameters.thickness_tolerance),
        workspace_(workspace) {
    const uint32_t count = list.list->count();
    if (workspace.program_counter.size() < count + CellList::kFirst) {
      workspace.segments.resize(count);
      workspace.computed.resize(count);
      workspace.reached.resize(count);
      workspace.apart.resize(count);
      workspace.program_counter.resize(count + CellList::kFirst, 0);
    }
    entries_ = list.list->primitive.data();
    segments_ = workspace.segments.data();
    computed_ = workspace.computed.data();
    reached_ = workspace.reached.data();
    apart_of_ = workspace.apart.data();
    const uint32_t* const if_inside = list.list->if_inside.data();
    const uint32_t* const if_outside = list.list->if_outside.data();
    uint32_t next = CellList::kTrue;
    for (uint32_t i = 0; i < count; ++i) {
      const LaneMask reached = list.reached ? list.reached[i] : kAllLanes;
      reached_[i] = reached;
      computed_[i] = apart_of_[i] = 0;
      // The primitives of a large scene are scattered in memory.
      if (reached != 0) prefetch_rays_part(primitive(i));
      all_must_hold_ &= (if_inside[i] == CellList::kFalse && if_outside[i] == next) ||
                        (if_inside[i] == next && if_outside[i] == CellList::kFalse);
      next = i + CellList::kFirst;
    }
    all_must_hold_ &= list.list->root == next;
  }
  /// Returns whether the list is an intersection of its tests' operands: each test makes it false
  /// or leads on to the next one.
  HWY_INLINE bool all_must_hold() const { return all_must_hold_; }
  /// Returns the lanes that may meet the primitive. The others lie outside of it throughout.
  HWY_INLINE LaneMask reached(uint32_t index) const { return reached_[index]; }
  /// Returns whether the segments of all these lanes are computed.
  HWY_INLINE bool are_known(uint32_t index, LaneMask lanes) const {
    return (lanes & ~computed_[index]) == 0;
  }
  /// Returns the segments, after computing those of `lanes`. The windows that were not known are
  /// the first segments.
  HWY_INLINE const PacketSegments& compute(uint32_t index, LaneMask lanes) {
    PacketSegments& segments = segments_[index];
    if (!are_known(index, lanes)) {
      LaneMask& computed = computed_[index];
      const LaneMask missing = whole_fours(lanes & ~computed);
      if (computed == 0 && missing != kAllLanes) clear(segments);
      if (primitive(index).is_convex) {
        intersect_lanes(frame_, rays_, missing, primitive(index), segments);
      } else {
        open_windows(index, missing, computed == 0);
      }
      computed |= missing;
      workspace_.intersections += static_cast<uint64_t>(std::popcount(missing));
    }
    return segments;
  }
  /// Does the same, and moves windows on to the first segment that has not ended at t.
  HWY_INLINE const PacketSegments& at(uint32_t index, LaneMask lanes, const PacketV& t) {
    const PacketSegments& segments = compute(index, lanes);
    if (has_windows(index)) move_windows(index, segments.more & lanes, t);
    return segments;
  }
  /// Returns whether the primitive, whose segments are computed for some lane, is not convex.
  HWY_INLINE bool has_windows(uint32_t index) const {
    return any_windows_ && !primitive(index).is_convex;
  }

  /// Moves the windows of a primitive that is not convex to the segments that have a near crossing,
  /// or else to the first ones that have not ended at t. is_near(lane, crossing) tells which
  /// crossings are; none is beyond `last_near`. Lowers `gap` to the distance from t to the nearest
  /// crossing outside of the window, which may be near as well. The segments must be computed.
  template <class IsNear>
  HWY_NOINLINE void find_near(uint32_t index, LaneMask lanes, const PacketV& t,
                              const PacketV& last_near, const IsNear& is_near, PacketV& gap) {
    PacketLane at, last, gaps;
    store(t, at);
    store(last_near, last);
    store(gap, gaps);
    PacketSegmentLists& lists = lists_of(index);
    find_beyond(index, lanes, last);
    for_each_lane(lanes, [&](uint32_t lane) {
      const std::span<const RaySegment> known = lists.lanes[lane].segments();
      uint32_t window = static_cast<uint32_t>(lists.lanes[lane].ended_at(at[lane]));
      // The first near crossing may lie before t.
      uint32_t first = window;
      const auto touches = [&](const RaySegment& segment) {
        return is_near(lane, segment.start) || is_near(lane, segment.end);
      };
      while (first > 0 && touches(known[first - 1])) --first;
      for (uint32_t i = first; i < known.size() && known[i].start <= last[lane]; ++i) {
        if (!touches(known[i])) continue;
        window = i;
        break;
      }
      double& own_gap = gaps[lane];
      if (window > 0) own_gap = std::min(own_gap, std::abs(at[lane] - known[window - 1].end));
      if (window + 1 < known.size()) {
        own_gap = std::min(own_gap, std::abs(known[window + 1].start - at[lane]));
      }
      set_window(index, lists, lane, window);
    });
    load(gaps, gap);
  }

  /// Returns all segments of a lane with a primitive that is not convex.
  std::span<const RaySegment> all_segments(uint32_t index, uint32_t lane) {
    PacketLane endless;
    std::fill_n(endless, kPacketRays, kInfinity);
    find_beyond(index, LaneMask{1} << lane, endless);
    return lists_of(index).lanes[lane].segments();
  }

  /// Finds the normals of all chunks that hold any of the lanes. `t` is at crossings, and `on_cap`
  /// is theirs.
  HWY_INLINE void find_normals(uint32_t index, LaneMask lanes, const PacketV& t, LaneMask on_cap,
                               Lanes3<Wide> (&normals)[kChunks]) {
    if (has_windows(index)) {
      find_face_normals(index, lanes, t, normals);
    } else {
      csgcore::HWY_NAMESPACE::find_normals(frame_, rays_, lanes, primitive(index), t, on_cap,
                                           normals);
    }
  }
  /// Returns the normal of one lane.
  Vec3 normal_at(uint32_t index, uint32_t lane, double t, bool on_cap) {
    if (has_windows(index)) return face_normal(index, lane, t);
    const Single d;
    const auto is_on_cap = hn::Eq(hn::Set(d, on_cap ? 1.0 : 0.0), hn::Set(d, 1.0));
    const Lanes3<Single> normal = normal_of(d, primitive(index), frame_.pivot,
                                            load_rays(d, rays_, lane), hn::Set(d, t), is_on_cap);
    return {hn::GetLane(normal.x), hn::GetLane(normal.y), hn::GetLane(normal.z)};
  }
  /// Returns those of `lanes` whose points at t are separated from the primitive by kApart
  /// thickness tolerances. For a ball the test costs as much as the intersection, so that it
  /// returns none.
  HWY_INLINE LaneMask apart(uint32_t index, const PacketV& t, LaneMask lanes) {
    if (primitive(index).ball_radius > 0) return 0;
    LaneMask& known = apart_of_[index];
    if ((lanes & ~known) != 0) {
      if (!has_points_) find_points(rays_, t, apart_, points_);
      known |= lanes_apart(primitive(index), frame_.pivot, points_, apart_);
      has_points_ = any_apart_ = true;
    }
    return lanes & known;
  }
  /// Must be called when lanes have changed their t.
  HWY_INLINE void forget_apart(LaneMask lanes) {
    has_points_ = false;
    if (!any_apart_) return;
    for (uint32_t i = 0; i < list_.list->count(); ++i) apart_of_[i] &= ~lanes;
  }

  /// Computes the segments of all primitives for the lanes; those of primitives that they cannot
  /// meet become empty.
  void compute_all(LaneMask lanes) {
    for (uint32_t i = 0; i < list_.list->count(); ++i) {
      const LaneMask wanted = lanes & reached(i);
      if (wanted != 0) {
        compute(i, wanted);
      } else if (computed_[i] == 0) {
        clear(segments_[i]);
      }
    }
  }
  HWY_INLINE const CanonicalPrimitive& primitive(uint32_t index) const {
    return list_.primitives[entries_[index] & kPrimitiveBits];
  }
  /// The program counters of an evaluation: by the number of a test or of a constant, the lanes
  /// that evaluate this test next, or that have this value. Between evaluations the entries of
  /// tests are 0.
  HWY_INLINE LaneMask* program_counter() { return workspace_.program_counter.data(); }

 private:
  using PacketLane = double[kPacketRays];
  static HWY_INLINE void store(const PacketV& v, PacketLane& lanes) {
    for (int c = 0; c < kChunks; ++c) hn::StoreU(v.chunk[c], Wide(), lanes + first_lane(c));
  }
  static HWY_INLINE void load(const PacketLane& lanes, PacketV& v) {
    for (int c = 0; c < kChunks; ++c) v.chunk[c] = hn::LoadU(Wide(), lanes + first_lane(c));
  }

  HWY_INLINE PacketSegmentLists& lists_of(uint32_t index) {
    return workspace_.segment_store.lists_of(entries_[index] & kPrimitiveBits);
  }

  HWY_NOINLINE void open_windows(uint32_t index, LaneMask lanes, bool are_first) {
    any_windows_ = true;
    if (are_first) segments_[index].more = 0;
    PacketLane from;
    std::fill_n(from, kPacketRays, -kInfinity);
    aim(index, lanes, from);
  }
  HWY_NOINLINE void move_windows(uint32_t index, LaneMask lanes, const PacketV& t) {
    const Wide d;
    LaneMask ended = 0;
    for (const int c : ChunksOf(lanes)) {
      const WideV end = hn::Load(d, segments_[index].end + first_lane(c));
      ended |= bits_of(hn::Le(end, t.chunk[c]), c);
    }
    if ((ended & lanes) == 0) return;
    PacketLane from;
    store(t, from);
    aim(index, ended & lanes, from);
  }

  /// Makes the lanes' windows the first segments that have not ended at t.
  void aim(uint32_t index, LaneMask lanes, const PacketLane& t) {
    find_beyond(index, lanes, t);
    PacketSegmentLists& lists = lists_of(index);
    for_each_lane(lanes, [&](uint32_t lane) {
      set_window(index, lists, lane, static_cast<uint32_t>(lists.lanes[lane].ended_at(t[lane])));
    });
  }

  void set_window(uint32_t index, PacketSegmentLists& lists, uint32_t lane, uint32_t window) {
    PacketSegments& segments = segments_[index];
    const SegmentList& list = lists.lanes[lane];
    const LaneMask bit = LaneMask{1} << lane;
    const size_t known = list.segments().size();
    const bool exists = window < known;
    segments.start[lane] = exists ? list.segments()[window].start : kInfinity;
    segments.end[lane] = exists ? list.segments()[window].end : -kInfinity;
    segments.start_on_cap &= ~bit;
    segments.end_on_cap &= ~bit;
    const bool may_move = exists && (window + 1 < known || !list.is_complete());
    segments.more = (segments.more & ~bit) | (may_move ? bit : 0);
  }

  /// Extends the lanes' lists until the last segment has not ended at t, if there are so many.
  void find_beyond(uint32_t index, LaneMask lanes, const PacketLane& t) {
    PacketSegmentLists& lists = lists_of(index);
    for (;;) {
      LaneMask wanted = 0;
      for_each_lane(lanes, [&](uint32_t lane) {
        const SegmentList& list = lists.lanes[lane];
        const bool is_beyond = !list.segments().empty() && list.segments().back().end > t[lane];
        if (!is_beyond && !list.is_complete()) wanted |= LaneMask{1} << lane;
      });
      if (wanted == 0) return;
      extend(index, wanted, lists);
    }
  }

  /// Finds the next crossings of the lanes.
  HWY_NOINLINE void extend(uint32_t index, LaneMask lanes, PacketSegmentLists& lists) {
    CrossingSearch& search = workspace_.segment_store.search;
    const bool is_closed = csgcore::HWY_NAMESPACE::is_closed(primitive(index));
    for_each_lane(lanes,
                  [&](uint32_t lane) { search.lanes[lane].after = lists.lanes[lane].last(); });
    lists.begun |= lanes;
    lists.most = lists.most == 0 ? kFirstCrossings : 2 * lists.most;
    const bool finds_few =
        is_closed && lists.most <= kMostCrossings && !finds_all(primitive(index));
    search.most = finds_few ? lists.most : CrossingSearch::kAll;
    find_crossings(frame_, rays_, lanes, primitive(index), search);
    for_each_lane(lanes, [&](uint32_t lane) {
      const std::vector<Crossing>& found = search.lanes[lane].found;
      int turns = 0;
      for (const Crossing& crossing : found) turns += crossing.turn;
      if (is_closed || turns == 0) {
        lists.lanes[lane].take(found, found.size() < search.most);
      } else {
        lists.lanes[lane].take_sheets(
            found, [&](const Crossing& crossing) { return sheet_length(index, lane, crossing); });
      }
    });
  }

  /// NUMERICS.md, "Meshes".
  double sheet_length(uint32_t index, uint32_t lane, const Crossing& crossing) const {
    const Vec3 direction{rays_.direction[0][lane], rays_.direction[1][lane],
                         rays_.direction[2][lane]};
    const Vec3 normal =
        normal_of_face(frame_, primitive(index), crossing.face, rays_, lane, crossing.t, false);
    const double speed = std::abs(glm::dot(normal, direction));
    return sheet_thickness_ / std::max(speed, kSheetCosine * glm::length(direction));
  }

  /// Returns the normal of a primitive that is not convex where the lane crosses it at t.
  Vec3 face_normal(uint32_t index, uint32_t lane, double t) {
    const std::span<const RaySegment> segments = lists_of(index).lanes[lane].segments();
    const auto segment = std::ranges::find_if(
        segments, [&](const RaySegment& s) { return s.start == t || s.end == t; });
    if (segment == segments.end()) return Vec3(0.0);
    const bool leaves = segment->end == t;
    return normal_of_face(frame_, primitive(index),
                          leaves ? segment->end_face : segment->start_face, rays_, lane, t, leaves);
  }

  HWY_NOINLINE void find_face_normals(uint32_t index, LaneMask lanes, const PacketV& t,
                                      Lanes3<Wide> (&normals)[kChunks]) {
    PacketLane at;
    store(t, at);
    alignas(64) double found[3][kPacketRays] = {};
    for_each_lane(lanes, [&](uint32_t lane) {
      const Vec3 normal = face_normal(index, lane, at[lane]);
      for (int axis = 0; axis < 3; ++axis) found[axis][lane] = normal[axis];
    });
    for (const int c : ChunksOf(lanes)) normals[c] = load3(Wide(), found, first_lane(c));
  }

  static HWY_INLINE void clear(PacketSegments& segments) {
    const Wide d;
    for (int c = 0; c < kChunks; ++c) {
      hn::Store(hn::Set(d, kInfinity), d, segments.start + first_lane(c));
      hn::Store(hn::Set(d, -kInfinity), d, segments.end + first_lane(c));
    }
  }

  const FrameRays& frame_;
  const RayPacket& rays_;
  const TraceList& list_;
  const double apart_;
  const double sheet_thickness_;
  // These point into the vectors of the list and the workspace. The compiler would read the
  // vectors' own pointers again after every store of a mask.
  const uint32_t* entries_;
  PacketSegments* segments_;
  LaneMask* computed_;
  LaneMask* reached_;
  LaneMask* apart_of_;
  bool all_must_hold_ = true;
  bool any_apart_ = false;
  bool any_windows_ = false;  // of any primitive
  bool has_points_ = false;
  PacketPoints points_;  // the lanes' points at their t
  PacketWorkspace& workspace_;
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
