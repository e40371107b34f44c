// The crossings of rays' paths with the pieces of a revolved profile (revolution_path-inl.hpp).
// Included once per instruction set.
//
// The crossings with curves are the roots of a quartic in the curve's parameter. They are isolated
// by halving its range, and found by Newton's method between bounds (NUMERICS.md, "Profiles"). All
// paths of a vector halve together; each takes part in the ranges that it would visit alone.
#if defined(CSGCORE_REVOLUTION_PIECE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_REVOLUTION_PIECE_INL_HPP
#undef CSGCORE_REVOLUTION_PIECE_INL_HPP
#else
#define CSGCORE_REVOLUTION_PIECE_INL_HPP
#endif

#include <array>

#include "base/constants.hpp"
#include "primitives/crossings.hpp"
#include "primitives/revolution_path-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace revolution_rays {

HWY_INLINE WideM select(WideM mask, WideM yes, WideM no) {
  return hn::Or(hn::And(mask, yes), hn::AndNot(mask, no));
}
HWY_INLINE WideV clamped(WideV v, WideV low, WideV high) { return hn::Max(low, hn::Min(high, v)); }
HWY_INLINE WideM is_negative(WideV v) { return hn::Lt(v, hn::Zero(Wide())); }
HWY_INLINE WideM is_positive(WideV v) { return hn::Gt(v, hn::Zero(Wide())); }

/// The passage of a vector of paths by a piece, whose crossings it takes.
struct PiecePassage {
  const PathV& path;
  int chunk;
  uint32_t face;  // the piece's number
  CrossingSearch& search;

  /// `leads_in`: whether the piece leads into the path at τ, or out of it.
  HWY_INLINE void add(WideM lanes, WideV tau, WideM leads_in) const {
    alignas(64) double t[kLanes];
    hn::Store(path.base + path.unit * clamped(tau, path.first, path.last), Wide(), t);
    const LaneMask grows = bits_of(hn::Xor(leads_in, path.is_downwards), chunk);
    for_each_lane(bits_of(lanes, chunk), [&](uint32_t lane) {
      const int turn = (grows >> lane & 1) != 0 ? 1 : -1;
      search.lanes[lane].found.push_back({t[lane - first_lane(chunk)], face, turn});
    });
  }
};

// --- Lines ---

/// A vertex of the profile, and whether it lies within the paths.
struct VertexV {
  PointV point;
  WideM is_within;
};

/// Crosses a line, which makes a cone, whose radius at τ is (q + κ·τ)/Δz, and which a ray meets at
/// the roots of a·τ² + 2h·τ + c. As for frusta, h² − a·c is formed without the products that would
/// cancel.
HWY_INLINE void cross_line(const PiecePassage& passage, const VertexV& from, const VertexV& to,
                           WideM lanes) {
  const Wide d;
  const PathV& path = passage.path;
  const auto& [start, from_within] = from;
  const auto& [end, to_within] = to;
  const WideM is_single = hn::Xor(from_within, to_within);
  // What lies within the path is convex.
  const WideM may_be_pair = hn::And(
      lanes, hn::AndNot(hn::Or(from_within, to_within), is_positive(within(path, start, end))));
  if (hn::AllFalse(d, hn::Or(hn::And(lanes, is_single), may_be_pair))) return;
  const WideV two = hn::Set(d, 2.0), zero = hn::Zero(d);
  const WideV rise = end.height - start.height, growth = end.r - start.r;
  const WideV kappa = path.rise * growth;
  const WideV q = start.r * rise - growth * start.height;
  const WideV lean = q * path.run - kappa * path.start;
  const WideV turned = path.offset * kappa, level = path.offset * rise * path.run;
  const WideV discriminant = lean * lean + (turned - level) * (turned + level);
  const WideM is_pair = hn::And(may_be_pair, is_positive(discriminant));
  const WideM crosses = hn::Or(hn::And(lanes, is_single), is_pair);
  if (hn::AllFalse(d, crosses)) return;
  const WideV root = hn::Abs(rise) * hn::Sqrt(hn::Max(discriminant, zero));
  const WideV steep = path.run * rise;
  const WideV a = (steep - kappa) * (steep + kappa);
  const WideV h = steep * rise * path.start - q * kappa;
  const WideV rise2 = rise * rise;
  const WideV size = rise2 * (path.offset * path.offset + path.start * path.start) + q * q;
  const WideV c =
      rise2 * path.offset * path.offset + (rise * path.start - q) * (rise * path.start + q);
  const WideV at_start = start.height / path.rise, at_end = end.height / path.rise;
  const WideV low = hn::Min(at_start, at_end), high = hn::Max(at_start, at_end);
  const WideM is_ring = hn::And(is_single, hn::Eq(rise, zero));
  const WideM is_level = hn::Eq(path.rise, zero);
  const auto add_root = [&](WideM which, WideM leads_in) {
    // The ray leaves the cone outwards at the larger root if a > 0.
    const WideM is_outwards =
        hn::Xor(leads_in, hn::Xor(path.is_downwards, hn::Not(is_negative(rise))));
    const WideV signed_root = hn::IfThenElse(is_outwards, root, hn::Neg(root));
    const WideV signed_h = hn::IfThenElse(is_outwards, h, hn::Neg(h));
    const WideV own = signed_root - h, other = hn::Neg(h) - signed_root;
    // If the root nearly cancels h, the other form of it is exact, unless both are mere rounding,
    // as for a level ray that touches the cone.
    const WideM is_near = hn::And(hn::Gt(two * root, hn::Abs(h)), hn::Lt(root, two * hn::Abs(h)));
    const WideM is_sure = hn::Gt(h * h, hn::Set(d, kEpsilon) * hn::Abs(a) * size);
    const WideM cancels = hn::And(is_positive(signed_h), hn::And(is_near, is_sure));
    const WideV tau = hn::IfThenElse(cancels, c, own) / hn::IfThenElse(cancels, other, a);
    // Along the cone, a ray passes it somewhere between the edge's ends.
    const WideV between = hn::IfThenElse(hn::Eq(tau, tau), clamped(tau, low, high), low);
    const WideV on_cone = hn::IfThenElse(is_level, tau, between);
    passage.add(which, hn::IfThenElse(is_ring, at_start, on_cone), leads_in);
  };
  add_root(crosses, hn::Or(is_pair, to_within));
  if (!hn::AllFalse(d, is_pair)) add_root(is_pair, no_lanes(d));
}

// --- Curves ---

/// A point of a curve as paths see it: how far r is beyond the path's offset, in place of r. On a
/// curve that the path touches these differences are small, and rounding is as small as they are.
struct CurvePointV {
  WideV beyond, height, run;
};
/// A curve's polar form at two parameters: at equal ones it is the curve's point, and those of
/// a range's ends are the control points of the curve's part there.
struct PolarV {
  CurvePointV point;
  WideV weight;
};
/// A curve, or a part of one.
struct CurveV {
  PolarV start, control, end;
};

class CurveCrosser {
 public:
  HWY_INLINE explicit CurveCrosser(const PiecePassage& passage)
      : passage_(passage), path_(passage.path) {}

  HWY_INLINE void cross(const VertexV& from, const PointV& control, const VertexV& to,
                        double weight, WideM lanes) const {
    const Wide d;
    const auto& [start, from_within] = from;
    const auto& [end, to_within] = to;
    lanes = hn::And(lanes, may_cross(start, control, end, weight, from_within, to_within));
    if (hn::AllFalse(d, lanes)) return;
    const WideV one = hn::Set(d, 1.0);
    const CurveV curve{{curve_point(start), one},
                       {curve_point(control), hn::Set(d, weight)},
                       {curve_point(end), one}};
    const WideM start_below = is_negative(start.height), end_below = is_negative(end.height);
    const WideM is_below =
        select(path_.starts_nearest, start_below,
               hn::Not(hn::Xor(is_negative(path_.start), hn::Not(path_.is_downwards))));
    const WideM is_cut =
        hn::And(hn::And(lanes, path_.starts_nearest), hn::Xor(start_below, end_below));
    if (hn::AllFalse(d, is_cut)) {
      cross_half(curve, from_within, to_within, is_below, lanes);
      return;
    }
    // The path's two halves, of which one comes and one goes, are below and above its middle.
    const auto [before, beyond] = halves(curve);
    const WideM is_middle_within = hn::Gt(across2(before.end.point), path_.start * path_.start);
    cross_half(if_then_else(is_cut, before, curve), from_within,
               select(is_cut, is_middle_within, to_within), is_below, lanes);
    cross_half(beyond, is_middle_within, to_within, end_below, is_cut);
  }

 private:
  /// Returns the lanes for which not all coefficients of the Bernstein form of the curve's distance
  /// from the path have one sign, or for which the path's two halves may be too near to each other
  /// for these to tell.
  HWY_INLINE WideM may_cross(const PointV& start, const PointV& control, const PointV& end,
                             double weight, WideM from_within, WideM to_within) const {
    const WideV turns = hn::Set(Wide(), 2 * weight * weight);
    const WideV middle = turns * within(path_, control, control) + within(path_, start, end);
    WideM differs = hn::Xor(from_within, to_within);
    for (const WideV value : {within(path_, start, control), middle, within(path_, control, end)}) {
      differs = hn::Or(differs, hn::Xor(from_within, is_positive(value)));
    }
    return hn::Or(differs, hn::Xor(is_negative(start.height), is_negative(end.height)));
  }

  HWY_INLINE CurvePointV curve_point(const PointV& point) const {
    return {point.r - path_.offset, point.height, point.run};
  }
  /// The polar form of the function that is > 0 within the path.
  HWY_INLINE WideV within_curve(const CurvePointV& a, const CurvePointV& b) const {
    const WideV beside = a.beyond * b.beyond + path_.offset * (a.beyond + b.beyond);
    return path_.rise2 * beside - a.run * b.run;
  }
  HWY_INLINE WideV across2(const CurvePointV& p) const {
    return p.beyond * (p.beyond + hn::Set(Wide(), 2.0) * path_.offset);  // r² − offset²
  }

  static HWY_INLINE CurvePointV if_then_else(WideM mask, const CurvePointV& yes,
                                             const CurvePointV& no) {
    return {hn::IfThenElse(mask, yes.beyond, no.beyond),
            hn::IfThenElse(mask, yes.height, no.height), hn::IfThenElse(mask, yes.run, no.run)};
  }
  static HWY_INLINE PolarV if_then_else(WideM mask, const PolarV& yes, const PolarV& no) {
    return {if_then_else(mask, yes.point, no.point), hn::IfThenElse(mask, yes.weight, no.weight)};
  }
  static HWY_INLINE CurveV if_then_else(WideM mask, const CurveV& yes, const CurveV& no) {
    return {if_then_else(mask, yes.start, no.start), if_then_else(mask, yes.control, no.control),
            if_then_else(mask, yes.end, no.end)};
  }

  static HWY_INLINE CurvePointV mix(const CurvePointV& a, WideV a_weight, const CurvePointV& b,
                                    WideV b_weight) {
    const WideV sum = a_weight + b_weight;
    const WideV first = a_weight / sum, second = b_weight / sum;
    return {first * a.beyond + second * b.beyond, first * a.height + second * b.height,
            first * a.run + second * b.run};
  }

  struct Halves {
    CurveV before, beyond;
  };
  /// Divides curves at the heights of their paths' middles, by De Casteljau's division of a
  /// rational curve.
  HWY_NOINLINE Halves halves(const CurveV& curve) const {
    const Wide d;
    // The roots of start·a² + 2·middle·a·b + end·b², of which one is positive.
    const WideV middle = curve.control.weight * curve.control.point.height;
    const WideV start = curve.start.point.height, end = curve.end.point.height;
    const WideV root = hn::Sqrt(hn::Max(middle * middle - start * end, hn::Zero(d)));
    const WideV larger = hn::Abs(middle) + root;
    const WideM is_steeper_at_start = hn::Xor(is_negative(middle), is_negative(start));
    const WideV a = hn::IfThenElse(is_steeper_at_start, larger, hn::Abs(end));
    const WideV b = hn::IfThenElse(is_steeper_at_start, hn::Abs(start), larger);
    const WideV share = b / (a + b), rest = hn::Set(d, 1.0) - share;
    const auto between = [&](const PolarV& from, const PolarV& to) {
      const WideV from_weight = rest * from.weight, to_weight = share * to.weight;
      return PolarV{mix(from.point, from_weight, to.point, to_weight), from_weight + to_weight};
    };
    const PolarV left = between(curve.start, curve.control);
    const PolarV right = between(curve.control, curve.end);
    PolarV at = between(left, right);
    at.point.height = hn::Zero(d);
    at.point.run = path_.run_at_height;
    return {{curve.start, left, at}, {at, right, curve.end}};
  }

  static HWY_INLINE PolarV polar(const CurveV& curve, WideV s, WideV t) {
    const Wide d;
    const WideV one = hn::Set(d, 1.0);
    const auto& [start, control, end] = curve;
    const WideV a = (one - s) * (one - t) * start.weight;
    const WideV b = ((one - s) * t + s * (one - t)) * control.weight;
    const WideV c = s * t * end.weight;
    const WideV weight = a + b + c, inverse = one / weight;
    const auto value = [&](WideV at_start, WideV at_control, WideV at_end) {
      return (a * at_start + b * at_control + c * at_end) * inverse;
    };
    return {{value(start.point.beyond, control.point.beyond, end.point.beyond),
             value(start.point.height, control.point.height, end.point.height),
             value(start.point.run, control.point.run, end.point.run)},
            weight};
  }

  /// A range of a curve's parameters, the curve's points at its ends, on which sides of the path
  /// these lie, and the lanes that visit it.
  struct Range {
    double from, to;
    PolarV start, end;
    WideM from_within, to_within, lanes;
    int depth;
  };

  /// Returns by how much `within_curve` differs if r is off by a rounding. Less tells no side.
  HWY_INLINE WideV rounding(const CurvePointV& point) const {
    const WideV r = point.beyond + path_.offset;
    return hn::Set(Wide(), 2 * kEpsilon) * path_.rise2 * r * r;
  }
  /// Returns the side of the path on which a value lies, or `other` if it tells none.
  static HWY_INLINE WideM side(WideV value, WideV rounding, WideM other) {
    return select(hn::Gt(hn::Abs(value), rounding), is_positive(value), other);
  }

  /// The lanes for which the coefficients of the Bernstein form over a range change their sign once
  /// and more often: as often as there are roots, or more often by an even number (Descartes'
  /// rule). They are formed of the control points there, of which the middle one is given.
  /// Coefficients of the whole curve, divided, would have a rounding of what is far from the path.
  struct SignChanges {
    WideM any, several;
  };
  HWY_INLINE SignChanges sign_changes(const Range& range, const PolarV& control) const {
    const Wide d;
    const auto& [p, u] = range.start;
    const auto& [q, w] = control;
    const auto& [r, v] = range.end;
    const WideV least = hn::Max(hn::Max(rounding(p), rounding(q)), rounding(r));
    const WideV turns = hn::Set(d, 2.0) * w * w, ends = u * v;
    const WideV middle = turns * within_curve(q, q) + ends * within_curve(p, r);
    SignChanges changes{no_lanes(d), no_lanes(d)};
    WideM is_within = range.from_within;
    const auto add = [&](WideM is_next) {
      const WideM differs = hn::Xor(is_next, is_within);
      changes.several = hn::Or(changes.several, hn::And(changes.any, differs));
      changes.any = hn::Or(changes.any, differs);
      is_within = is_next;
    };
    add(side(within_curve(p, q), least, is_within));
    add(side(middle, least * (turns + ends), is_within));
    add(side(within_curve(q, r), least, is_within));
    add(range.to_within);
    return {hn::And(changes.any, range.lanes), hn::And(changes.several, range.lanes)};
  }

  /// Crosses the parts of curves that can meet only the lower or the upper half of their path.
  HWY_NOINLINE void cross_half(const CurveV& curve, WideM from_within, WideM to_within,
                               WideM is_below, WideM lanes) const {
    const Wide d;
    std::array<Range, kDeepest + 1> open;
    int count = 0;
    WideV ranges = hn::Zero(d);
    open[count++] = {0, 1, curve.start, curve.end, from_within, to_within, lanes, 0};
    while (count > 0) {
      const Range range = open[--count];
      const WideV from = hn::Set(d, range.from), to = hn::Set(d, range.to);
      const PolarV control = range.depth == 0 ? curve.control : polar(curve, from, to);
      const auto [any, several] = sign_changes(range, control);
      WideM divides = no_lanes(d);
      if (range.depth < kDeepest && !hn::AllFalse(d, several)) {
        ranges = hn::IfThenElse(several, ranges + hn::Set(d, 1.0), ranges);
        divides = hn::And(several, hn::Le(ranges, hn::Set(d, kMostRanges)));
      }
      const WideM has_root =
          hn::And(hn::AndNot(divides, any), hn::Xor(range.from_within, range.to_within));
      if (!hn::AllFalse(d, has_root)) add_root(curve, range, is_below, has_root);
      if (hn::AllFalse(d, divides)) continue;
      const double middle = 0.5 * (range.from + range.to);
      const WideV middles = hn::Set(d, middle);
      const PolarV at = polar(curve, middles, middles);
      const WideM is_within =
          side(within_curve(at.point, at.point), rounding(at.point), range.from_within);
      const int depth = range.depth + 1;
      open[count++] = {middle, range.to, at, range.end, is_within, range.to_within, divides, depth};
      open[count++] = {range.from,        middle,    range.start, at,
                       range.from_within, is_within, divides,     depth};
    }
  }

  static constexpr double kLeastGrowth = 0x1p-26;  // the root of a rounding
  /// Two roots that are closer than this power of 1/2 are a touch that rounding may miss.
  static constexpr int kDeepest = 53;
  /// Four roots are isolated by fewer halvings. More there are only where the curve runs along the
  /// path within its rounding, so that any sign is right.
  static constexpr int kMostRanges = 4 * kDeepest;

  /// The quartic, `within_curve` times the weight's square, and its growth.
  struct Quartic {
    WideV value, growth;
  };
  HWY_INLINE Quartic quartic(const CurveV& curve, WideV s) const {
    const Wide d;
    const WideV one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
    const WideV w0 = curve.start.weight, w1 = curve.control.weight, w2 = curve.end.weight;
    const WideV rest = one - s;
    const WideV a = rest * rest * w0, b = two * rest * s * w1, c = s * s * w2;
    const WideV da = hn::Set(d, -2.0) * rest * w0, db = two * (one - two * s) * w1,
                dc = two * s * w2;
    const WideV weight = a + b + c, weight_growth = da + db + dc;
    const CurvePointV &start = curve.start.point, &control = curve.control.point,
                      &end = curve.end.point;
    const auto beyond_by = [&](WideV u, WideV v, WideV w) {
      return u * start.beyond + v * control.beyond + w * end.beyond;
    };
    const auto run_by = [&](WideV u, WideV v, WideV w) {
      return u * start.run + v * control.run + w * end.run;
    };
    const WideV beyond = beyond_by(a, b, c), beyond_growth = beyond_by(da, db, dc);
    const WideV run = run_by(a, b, c), run_growth = run_by(da, db, dc);
    const WideV offset = path_.offset;
    return {path_.rise2 * beyond * (beyond + two * offset * weight) - run * run,
            two * (path_.rise2 * (beyond * beyond_growth +
                                  offset * (beyond_growth * weight + beyond * weight_growth)) -
                   run * run_growth)};
  }

  /// Returns where the quartic's chord over a range is 0, but not close to its ends, where the
  /// quartic may be 0 for all that can be told.
  HWY_INLINE WideV first_guess(const CurveV& curve, const Range& range) const {
    const Wide d;
    const WideV from = hn::Set(d, range.from), to = hn::Set(d, range.to);
    const WideV start = quartic(curve, from).value, end = quartic(curve, to).value;
    const WideV share = start / (start - end);
    constexpr double kLeastShare = 0x1p-5;
    const WideM is_inside =
        hn::And(hn::Gt(share, hn::Set(d, kLeastShare)), hn::Lt(share, hn::Set(d, 1 - kLeastShare)));
    return from + (to - from) * hn::IfThenElse(is_inside, share, hn::Set(d, 0.5));
  }

  /// Adds the only root in a range, by Newton's method between bounds.
  HWY_INLINE void add_root(const CurveV& curve, const Range& range, WideM is_below,
                           WideM lanes) const {
    const Wide d;
    const WideV half = hn::Set(d, 0.5);
    const WideV range_from = hn::Set(d, range.from), range_to = hn::Set(d, range.to);
    WideV from = range_from, to = range_to;
    constexpr int kMostSteps = 200, kQuickSteps = 12;
    constexpr double kLeastStep = 0x1p-54;
    // Where steps shrink faster than this share, as they do next to a root that is no touch, they
    // do so by more from one to the next, and one that follows a small one is less than a rounding.
    constexpr double kFastShare = 0x1p-10, kSmallStep = 0x1p-40;
    WideV last_step = hn::Set(d, 1.0);
    // A level path is met at its middle.
    const WideM is_level = hn::Eq(path_.rise, hn::Zero(d));
    WideV s = hn::IfThenElse(is_level, hn::IfThenElse(range.to_within, to, from),
                             first_guess(curve, range));
    WideM live = hn::AndNot(is_level, lanes);
    for (int step = 0; step < kMostSteps && !hn::AllFalse(d, live); ++step) {
      const auto [value, growth] = quartic(curve, s);
      const WideM is_beyond = hn::Xor(is_positive(value), range.from_within);
      from = hn::IfThenElse(is_beyond, from, s);
      to = hn::IfThenElse(is_beyond, s, to);
      WideV next = s - value / growth;
      const WideV size = hn::Abs(next - s);
      const WideM is_fast = hn::And(hn::Le(size, hn::Set(d, kSmallStep)),
                                    hn::Le(size, hn::Set(d, kFastShare) * last_step));
      const WideM is_last = hn::Or(hn::Le(size, hn::Set(d, kLeastStep)), is_fast);
      last_step = size;
      const WideM is_inside = hn::And(hn::Gt(next, from), hn::Lt(next, to));
      const WideV bound = step % kQuickSteps == kQuickSteps - 1
                              ? half * (from + to)
                              : hn::IfThenElse(is_inside, next, half * (from + to));
      next = hn::IfThenElse(is_last, clamped(next, range_from, range_to), bound);
      const WideM is_end = hn::Or(hn::Eq(next, from), hn::Eq(next, to));
      s = hn::IfThenElse(live, next, s);
      live = hn::AndNot(hn::Or(is_last, is_end), live);
    }
    const CurvePointV point = polar(curve, s, s).point;
    const WideV across = hn::Sqrt(hn::Max(across2(point), hn::Zero(d)));
    const WideM comes = hn::Xor(is_below, path_.is_downwards);
    const WideV rho = hn::IfThenElse(comes, hn::Neg(across), across);
    const WideV r = point.beyond + path_.offset;
    // The height of the point and its ρ both tell τ. Its error in the one case is a rounding over
    // the rise. In the other it is that over how fast r grows, but not more than a rounding's root.
    const WideV growth = hn::Max(across, hn::Set(d, kLeastGrowth) * r) * path_.run;
    const WideM by_height = hn::Ge(hn::Abs(path_.rise) * r, growth);
    const WideV way = hn::IfThenElse(by_height, point.height, rho - path_.start);
    passage_.add(lanes, way / hn::IfThenElse(by_height, path_.rise, path_.run), range.to_within);
  }

  const PiecePassage& passage_;
  const PathV& path_;
};

/// Adds the crossings of the lanes' paths with the pieces from `begin` up to `end`.
HWY_NOINLINE static HWY_MAYBE_UNUSED void cross_pieces(const Profile& profile,
                                                       const PacketPaths& paths, uint32_t begin,
                                                       uint32_t end, LaneMask lanes,
                                                       CrossingSearch& search) {
  for (const int c : ChunksOf(lanes)) {
    const PathV& path = paths.chunk[c];
    const auto vertex = [&](const Vec2& place) {
      const PointV point = seen(path, profile, place);
      return VertexV{point, is_within(path, point)};
    };
    VertexV from, to;
    for (uint32_t i = begin; i < end; ++i) {
      const Profile::Piece& piece = profile.pieces()[i];
      const bool goes_on = i > begin && piece.start == profile.pieces()[i - 1].end;
      from = goes_on ? to : vertex(piece.start);
      to = vertex(piece.end);
      const PiecePassage passage{path, c, i, search};
      if (piece.is_line()) {
        cross_line(passage, from, to, mask_of(lanes, c));
      } else {
        CurveCrosser(passage).cross(from, seen(path, profile, piece.control), to, piece.weight,
                                    mask_of(lanes, c));
      }
    }
  }
}

}  // namespace revolution_rays
}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
