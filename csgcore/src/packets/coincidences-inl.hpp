// Coincidence resolution for all lanes of a packet at once, where it is plain which crossings
// coincide (NUMERICS.md, "Coincidences"). Included once per instruction set.
#if defined(CSGCORE_CLUSTERS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_CLUSTERS_INL_HPP
#undef CSGCORE_CLUSTERS_INL_HPP
#else
#define CSGCORE_CLUSTERS_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "packets/walk-inl.hpp"
#include "tree/list_expression.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// A coincidence is *plain* if its crossings are at least this many tolerances away from all other
/// crossings, and if none of its faces is met at so small an angle that a primitive separated by
/// kApart, divided by this number, might coincide with it. RayResolver handles the rest: rays that
/// pass within some tolerances of an edge, or along a face.
constexpr double kPlain = 2.0;

/// The coincidences at the lanes' t.
struct Coincidences {
  LaneMask plain = 0;   // lanes whose coincidence is plain
  LaneMask turned = 0;  // of these, the lanes whose value changes across the coincidence
  PacketV end;          // t of its last crossing
};

/// Finds coincidences of one packet and list.
class CoincidenceFinder {
 public:
  CoincidenceFinder(const RayPacket& rays, const TraceList& trace,
                    const TraceParameters& parameters, ListSegments& segments,
                    PacketWorkspace& workspace)
      : rays_(rays),
        trace_(trace),
        parameters_(parameters),
        segments_(segments),
        expression_(workspace.expression),
        states_(workspace.states) {
    const Wide d;
    expression_.parse(*trace.list);
    for (int c = 0; c < kChunks; ++c) {
      const WideV inverse_length2 = hn::Load(d, rays.inverse_length2 + first_lane(c));
      near_.chunk[c] =
          hn::Mul(hn::Set(d, parameters.thickness_tolerance), hn::Sqrt(inverse_length2));
    }
  }

  /// Finds the coincidences of lanes whose t is at a boundary, and whose value before it is
  /// `value`. Crossings up to `from` are passed already.
  HWY_NOINLINE Coincidences find(const Walk& walk, LaneMask lanes, bool value,
                                 const PacketV& from) {
    const Wide d;
    lanes_ = lanes;
    value_ = value;
    t_ = walk.t;
    from_ = from;
    furthest_t_ = furthest_of(walk.t, lanes);
    any_apart_ = false;
    for (int c = 0; c < kChunks; ++c) {
      gap_.chunk[c] = facing_.chunk[c] = hn::Set(d, kInfinity);
      end_.chunk[c] = t_.chunk[c];
    }
    size_t depth = 0;
    uint32_t index = 0;
    for (const ListExpression::Step step : expression_.steps()) {
      if (step == ListExpression::Step::kTest) {
        if (states_.size() <= depth) states_.resize(2 * depth + 1);
        write_state(index++, states_[depth++]);
      } else {
        --depth;
        const bool is_union = (step == ListExpression::Step::kUnion) != value;
        combine(is_union, states_[depth], states_[depth - 1]);
      }
    }
    Coincidences coincidences;
    coincidences.plain = depth == 1 ? plain_lanes() : 0;
    coincidences.turned = coincidences.plain & turned_lanes();
    coincidences.end = end_;
    return coincidences;
  }

  /// Stores the hits of lanes whose coincidence, as the last find() found it, has turned.
  HWY_NOINLINE void show(LaneMask lanes, PacketHits& hits) {
    const int32_t* const shown = states_[0].lane;
    for (LaneMask left = lanes; left != 0;) {
      const auto primitive = static_cast<uint32_t>(shown[std::countr_zero(left)]);
      LaneMask same = 0;
      for (LaneMask others = left; others != 0; others &= others - 1) {
        const int lane = std::countr_zero(others);
        if (static_cast<uint32_t>(shown[lane]) == primitive) same |= LaneMask{1} << lane;
      }
      left &= ~same;
      show_primitive(primitive, same, hits);
    }
  }

 private:
  using Ints = hn::CappedTag<int32_t, 16>;

  /// Stores the primitive's crossings as the hits of the lanes.
  void show_primitive(uint32_t primitive, LaneMask lanes, PacketHits& hits) {
    const Wide d;
    for (uint32_t index = 0; lanes != 0 && index < trace_.list->count(); ++index) {
      const uint32_t entry = trace_.list->primitive[index];
      if ((entry & kPrimitiveBits) != primitive) continue;
      const bool complement = (entry & CellList::kComplementBit) != 0;
      // If the list has the primitive both as such and as a complement, one of its tests turns this
      // way.
      const bool at_end = complement != value_;
      const PacketSegments& segment = segments_.compute(index, lanes);
      const double* const own = at_end ? segment.end : segment.start;
      const double* const other = at_end ? segment.start : segment.end;
      PacketV t;
      LaneMask here = 0;
      for (int c = 0; c < kChunks; ++c) {
        t.chunk[c] = hn::Load(d, own + first_lane(c));
        const WideM turns =
            hn::AndNot(is_near(hn::Load(d, other + first_lane(c)), c), is_near(t.chunk[c], c));
        here |= bits_of(turns, c);
      }
      here &= lanes;
      if (here == 0) continue;
      lanes &= ~here;
      const LaneMask on_cap = at_end ? segment.end_on_cap : segment.start_on_cap;
      Lanes3<Wide> normals[kChunks];
      segments_.find_normals(index, here, t, on_cap, normals);
      hits.hits |= here;
      hits.on_cap = (hits.on_cap & ~here) | (on_cap & here);
      fill_lanes(here, index, hits.index);
      const WideV sign = hn::Set(d, complement ? -1.0 : 1.0);
      for (const int c : ChunksOf(here)) {
        const WideM mask = mask_of(here, c);
        const size_t first = first_lane(c);
        const Lanes3<Wide> before = load3(d, hits.normal, first);
        store3(d, if_then_else(mask, scaled(normals[c], sign), before), hits.normal, first);
        hn::Store(hn::IfThenElse(mask, t.chunk[c], hn::Load(d, hits.t + first)), d, hits.t + first);
      }
    }
  }

  /// Returns whether a crossing is less than the tolerance away along the ray from that at the
  /// lanes' t. Then the two coincide whatever their normals, since |n·d| ≤ |d|.
  HWY_INLINE WideM is_near(WideV crossing, int chunk) const {
    const WideV gap = hn::Abs(hn::Sub(crossing, t_.chunk[chunk]));
    return hn::And(hn::Lt(gap, near_.chunk[chunk]), hn::Lt(from_.chunk[chunk], crossing));
  }

  /// Returns the lanes that must be intersected with a primitive. The others lie outside of it
  /// there.
  HWY_INLINE LaneMask lanes_to_ask(uint32_t index) {
    const Wide d;
    LaneMask asked = lanes_ & segments_.reached(index);
    if (asked == 0 || segments_.are_known(index, asked)) return asked;
    const double nearest_t = trace_.nearest_t[index];
    if (furthest_t_ < nearest_t) {
      for (int c = 0; c < kChunks; ++c) {
        const WideV ahead = hn::Sub(hn::Set(d, nearest_t), t_.chunk[c]);
        WideV& gap = gap_.chunk[c];
        gap = hn::IfThenElse(mask_of(asked, c), hn::Min(gap, ahead), gap);
      }
      return 0;
    }
    const LaneMask apart = segments_.apart(index, t_, asked);
    any_apart_ |= apart != 0;
    return asked & ~apart;
  }

  /// Writes the test's state in the coincidence; that of its negation if `value_` is true, so that
  /// what ends is treated like what starts.
  HWY_INLINE void write_state(uint32_t index, PacketStates& states) {
    const Wide d;
    const uint32_t entry = trace_.list->primitive[index];
    const LaneMask asked = lanes_to_ask(index);
    LaneMask before = 0;
    LaneMask behind = 0;
    if (asked != 0) {
      const PacketSegments& segment = segments_.compute(index, asked);
      if (segments_.has_windows(index)) aim_at_near_crossings(index, asked);
      LaneMask starts = 0;
      LaneMask ends = 0;
      PacketV start, end;
      for (int c = 0; c < kChunks; ++c) {
        const WideV t = t_.chunk[c];
        start.chunk[c] = hn::Load(d, segment.start + first_lane(c));
        end.chunk[c] = hn::Load(d, segment.end + first_lane(c));
        const WideM starts_here = is_near(start.chunk[c], c);
        const WideM ends_here = is_near(end.chunk[c], c);
        const WideM was_in = hn::AndNot(starts_here, hn::Le(start.chunk[c], t));
        const WideM was_out = hn::AndNot(ends_here, hn::Le(end.chunk[c], t));
        before |= bits_of(hn::AndNot(was_out, was_in), c);
        behind |= bits_of(hn::AndNot(hn::Or(was_out, ends_here), hn::Or(was_in, starts_here)), c);
        starts |= bits_of(starts_here, c);
        ends |= bits_of(ends_here, c);
        keep_gap(starts_here, start.chunk[c], c);
        keep_gap(ends_here, end.chunk[c], c);
      }
      before &= asked;
      behind &= asked;
      keep_facing(index, starts & asked, segment.start_on_cap, start);
      keep_facing(index, ends & asked, segment.end_on_cap, end);
    }
    const bool is_negated = ((entry & CellList::kComplementBit) != 0) != value_;
    if (is_negated) before = ~before, behind = ~behind;
    const Ints i;
    const auto primitive = hn::Set(i, static_cast<int32_t>(entry & kPrimitiveBits));
    for (size_t first = 0; first < kPacketRays; first += hn::Lanes(i)) {
      const auto held = mask_from(i, before >> first);
      const auto holds = mask_from(i, behind >> first);
      const auto if_holds = hn::IfThenElse(held, hn::Set(i, turning::kHolds), primitive);
      const auto if_not =
          hn::IfThenElse(held, hn::Set(i, turning::kEnds), hn::Set(i, turning::kFails));
      hn::Store(hn::IfThenElse(holds, if_holds, if_not), i, states.lane + first);
    }
  }

  /// Moves the windows of a primitive that is not convex to its near crossings. If a lane has
  /// others outside of its window, the gap to them keeps its coincidence from being plain.
  HWY_NOINLINE void aim_at_near_crossings(uint32_t index, LaneMask lanes) {
    double t[kPacketRays], near[kPacketRays], from[kPacketRays];
    PacketV last_near;
    for (int c = 0; c < kChunks; ++c) {
      hn::StoreU(t_.chunk[c], Wide(), t + first_lane(c));
      hn::StoreU(near_.chunk[c], Wide(), near + first_lane(c));
      hn::StoreU(from_.chunk[c], Wide(), from + first_lane(c));
      // Twice as far is beyond any rounding.
      last_near.chunk[c] = hn::Add(t_.chunk[c], hn::Add(near_.chunk[c], near_.chunk[c]));
    }
    segments_.find_near(
        index, lanes, t_, last_near,
        [&](uint32_t lane, double crossing) {
          return std::abs(crossing - t[lane]) < near[lane] && from[lane] < crossing;
        },
        gap_);
  }

  /// Updates gap_, the distance to the nearest crossing outside of the coincidence, and end_, the
  /// last crossing in it.
  HWY_INLINE void keep_gap(WideM is_near, WideV crossing, int c) {
    WideV& gap = gap_.chunk[c];
    const WideV other = hn::Abs(hn::Sub(crossing, t_.chunk[c]));
    gap = hn::IfThenElse(is_near, gap, hn::Min(gap, other));
    WideV& end = end_.chunk[c];
    end = hn::IfThenElse(is_near, hn::Max(end, crossing), end);
  }

  /// Updates facing_, the least |n·d| of the coincidence's crossings: thickness per unit of t.
  HWY_INLINE void keep_facing(uint32_t index, LaneMask lanes, LaneMask on_cap, const PacketV& t) {
    if (lanes == 0) return;
    Lanes3<Wide> normals[kChunks];
    segments_.find_normals(index, lanes, t, on_cap, normals);
    for (const int c : ChunksOf(lanes)) {
      const Lanes3<Wide> direction = load3(Wide(), rays_.direction, first_lane(c));
      const WideV own = hn::Abs(dot(Wide(), normals[c], direction));
      WideV& facing = facing_.chunk[c];
      facing = hn::IfThenElse(mask_of(lanes, c), hn::Min(facing, own), facing);
    }
  }

  HWY_INLINE static void combine(bool is_union, const PacketStates& from, PacketStates& to) {
    const Ints i;
    const auto holds = hn::Set(i, turning::kHolds);
    const auto fails = hn::Set(i, turning::kFails);
    const auto ends = hn::Set(i, turning::kEnds);
    for (size_t first = 0; first < kPacketRays; first += hn::Lanes(i)) {
      const auto a = hn::Load(i, from.lane + first);
      const auto b = hn::Load(i, to.lane + first);
      const auto last = hn::Max(a, b);
      const auto first_of_both = hn::Min(a, b);
      // These are turning::union_of and turning::intersection_of.
      if (is_union) {
        const auto hands_over = hn::And(hn::Eq(first_of_both, ends), hn::Gt(last, ends));
        hn::Store(hn::IfThenElse(hands_over, holds, last), i, to.lane + first);
      } else {
        const auto first_counts = hn::Or(hn::Eq(last, holds), hn::Eq(first_of_both, last));
        const auto otherwise = hn::IfThenElse(hn::Gt(first_of_both, ends), last, fails);
        hn::Store(hn::IfThenElse(first_counts, first_of_both, otherwise), i, to.lane + first);
      }
    }
  }

  /// Returns the lanes with whose coincidence no other crossing can coincide.
  LaneMask plain_lanes() const {
    const Wide d;
    LaneMask plain = 0;
    for (int c = 0; c < kChunks; ++c) {
      const WideV facing = facing_.chunk[c];
      const WideV thickness = hn::Mul(hn::Sub(gap_.chunk[c], near_.chunk[c]), facing);
      WideM is_plain = hn::Ge(thickness, hn::Set(d, kPlain * parameters_.thickness_tolerance));
      if (any_apart_) {
        const WideV cosine2 =
            hn::Mul(hn::Mul(facing, facing), hn::Load(d, rays_.inverse_length2 + first_lane(c)));
        constexpr double kLeast = kPlain / kApart;
        is_plain = hn::And(is_plain, hn::Ge(cosine2, hn::Set(d, kLeast * kLeast)));
      }
      plain |= bits_of(is_plain, c);
    }
    return plain & lanes_;
  }

  LaneMask turned_lanes() const {
    LaneMask turned = 0;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      turned |= LaneMask{turning::is_turned(states_[0].lane[lane])} << lane;
    }
    return turned;
  }

  const RayPacket& rays_;
  const TraceList& trace_;
  const TraceParameters& parameters_;
  ListSegments& segments_;
  ListExpression& expression_;
  std::vector<PacketStates>& states_;
  PacketV near_;  // in t: crossings nearer than that coincide, whatever their normals
  // The state of one find():
  LaneMask lanes_ = 0;
  bool value_ = false;
  bool any_apart_ = false;
  double furthest_t_ = 0;
  PacketV t_, from_, gap_, facing_, end_;
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
