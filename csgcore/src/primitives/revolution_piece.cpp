#include "primitives/revolution_piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.hpp"

namespace csgcore {
namespace {

// The crossings with curves are the roots of a quartic in the curve's parameter. They are isolated
// by halving its range, and found by Newton's method between bounds (NUMERICS.md, "Profiles").

/// The passage of a path by a piece, whose crossings it takes.
struct PiecePassage {
  const RevolutionPath& path;
  uint32_t face;  // the piece's number
  std::vector<Crossing>& found;

  /// `change`: 1 if the piece leads into the path at τ, −1 if it leads out of it.
  void add(double tau, int change) const {
    const double within_solid = std::clamp(tau, path.first, path.last);
    found.push_back({path.base + path.unit * within_solid, face, change * path.upwards()});
  }
};

/// A curve as a path sees it, and whether its ends lie within the path.
struct PathCurve {
  PathPoint start, control, end;
  double weight;
  bool from_within, to_within;
};

class CurveCrosser {
 public:
  explicit CurveCrosser(const PiecePassage& passage) : passage_(passage), path_(passage.path) {}

  void cross(const PathCurve& curve) const {
    cross({curve_point(curve.start), curve_point(curve.control), curve_point(curve.end),
           curve.weight},
          curve.from_within, curve.to_within);
  }

 private:
  /// A point of a curve as the path sees it: how far r is beyond the path's offset, in place of r.
  /// On a curve that the path touches these differences are small, and rounding is as small as
  /// they are.
  struct CurvePoint {
    double beyond, height, run;
  };
  /// A curve, or a part of one, whose control points have weights of their own.
  struct Curve {
    CurvePoint start, control, end;
    double weight, start_weight = 1, end_weight = 1;
  };

  CurvePoint curve_point(const PathPoint& point) const {
    return {point.r - path_.offset, point.height, point.run};
  }
  /// The polar form of the function that is > 0 within the path.
  double within_curve(const CurvePoint& a, const CurvePoint& b) const {
    const double beside = a.beyond * b.beyond + path_.offset * (a.beyond + b.beyond);
    return path_.rise * path_.rise * beside - a.run * b.run;
  }
  double across2(const CurvePoint& p) const {
    return p.beyond * (p.beyond + 2 * path_.offset);  // r² − offset²
  }

  void cross(const Curve& curve, bool from_within, bool to_within) const {
    if (path_.starts_nearest && (curve.start.height < 0) != (curve.end.height < 0)) {
      // The path's two halves, of which one comes and one goes, are below and above its middle.
      const Curve halves[] = {below_or_above(curve, true), below_or_above(curve, false)};
      const bool is_middle_within = across2(halves[0].end) > path_.start * path_.start;
      cross_half(halves[0], from_within, is_middle_within, curve.start.height < 0);
      cross_half(halves[1], is_middle_within, to_within, curve.end.height < 0);
    } else {
      const bool is_below = path_.starts_nearest ? curve.start.height < 0
                                                 : (path_.start < 0) == (path_.upwards() > 0);
      cross_half(curve, from_within, to_within, is_below);
    }
  }

  /// Returns the part of a curve before or after the height of the path's middle.
  Curve below_or_above(const Curve& curve, bool before) const {
    // The roots of start·a² + 2·middle·a·b + end·b², of which one is positive.
    const double middle = curve.weight * curve.control.height;
    const double start = curve.start.height, end = curve.end.height;
    const double root = std::sqrt(std::max(0.0, middle * middle - start * end));
    const double larger = std::abs(middle) + root;
    const bool is_steeper_at_start = (middle < 0) == (start < 0) ? false : true;
    const double a = is_steeper_at_start ? larger : std::abs(end);
    const double b = is_steeper_at_start ? std::abs(start) : larger;
    const double share = b / (a + b);
    const auto [left, right, at, left_weight, right_weight, weight] = divided(curve, share);
    CurvePoint cut = at;
    cut.height = 0;
    cut.run = path_.rise * path_.start;
    return before ? Curve{curve.start, left, cut, left_weight, curve.start_weight, weight}
                  : Curve{cut, right, curve.end, right_weight, weight, curve.end_weight};
  }

  struct Division {
    CurvePoint left, right, at;
    double left_weight, right_weight, weight;
  };
  static CurvePoint mix(const CurvePoint& a, double a_weight, const CurvePoint& b,
                        double b_weight) {
    const double sum = a_weight + b_weight;
    const double first = a_weight / sum, second = b_weight / sum;
    return {first * a.beyond + second * b.beyond, first * a.height + second * b.height,
            first * a.run + second * b.run};
  }
  /// De Casteljau's division of a rational curve.
  static Division divided(const Curve& curve, double share) {
    const double rest = 1 - share;
    Division result;
    result.left_weight = rest * curve.start_weight + share * curve.weight;
    result.right_weight = rest * curve.weight + share * curve.end_weight;
    result.weight = rest * result.left_weight + share * result.right_weight;
    result.left = mix(curve.start, rest * curve.start_weight, curve.control, share * curve.weight);
    result.right = mix(curve.control, rest * curve.weight, curve.end, share * curve.end_weight);
    result.at =
        mix(result.left, rest * result.left_weight, result.right, share * result.right_weight);
    return result;
  }

  /// The curve's polar form at two parameters: at equal ones it is the curve's point, and those of
  /// a range's ends are the control points of the curve's part there.
  struct Polar {
    CurvePoint point;
    double weight;
  };
  static Polar polar(const Curve& curve, double s, double t) {
    const double a = (1 - s) * (1 - t) * curve.start_weight;
    const double b = ((1 - s) * t + s * (1 - t)) * curve.weight;
    const double c = s * t * curve.end_weight;
    const double weight = a + b + c, inverse = 1 / weight;
    const auto value = [&](double start, double control, double end) {
      return (a * start + b * control + c * end) * inverse;
    };
    return {{value(curve.start.beyond, curve.control.beyond, curve.end.beyond),
             value(curve.start.height, curve.control.height, curve.end.height),
             value(curve.start.run, curve.control.run, curve.end.run)},
            weight};
  }

  /// A range of a curve's parameters, the curve's points at its ends, and on which sides of the
  /// path these lie.
  struct Range {
    double from, to;
    Polar start, end;
    bool from_within, to_within;
    int depth;
  };

  /// Returns by how much `within_curve` differs if r is off by a rounding. Less tells no side.
  double rounding(const CurvePoint& point) const {
    const double r = point.beyond + path_.offset;
    return 2 * kEpsilon * path_.rise * path_.rise * r * r;
  }
  /// Returns the side of the path on which a value lies, or `other` if it tells none.
  static bool side(double value, double rounding, bool other) {
    return std::abs(value) > rounding ? value > 0 : other;
  }

  /// Returns how often the coefficients of the Bernstein form over a range change their sign: as
  /// often as there are roots, or more often by an even number (Descartes' rule). They are formed
  /// of the control points there, of which the middle one is given. Coefficients of the whole
  /// curve, divided, would have a rounding of what is far from the path.
  int sign_changes(const Range& range, const Polar& control) const {
    const auto& [p, u] = range.start;
    const auto& [q, w] = control;
    const auto& [r, v] = range.end;
    const double least = std::max({rounding(p), rounding(q), rounding(r)});
    const double middle = 2 * w * w * within_curve(q, q) + u * v * within_curve(p, r);
    int changes = 0;
    bool is_within = range.from_within;
    const auto add = [&](bool is_next) {
      changes += is_next != is_within;
      is_within = is_next;
    };
    add(side(within_curve(p, q), least, is_within));
    add(side(middle, least * (2 * w * w + u * v), is_within));
    add(side(within_curve(q, r), least, is_within));
    add(range.to_within);
    return changes;
  }

  /// Crosses the part of a curve that can meet only the lower or the upper half of the path. Its
  /// roots are isolated by halving.
  void cross_half(const Curve& curve, bool from_within, bool to_within, bool is_below) const {
    std::array<Range, kDeepest + 1> open;
    int count = 0, ranges = 0;
    const Polar start{curve.start, curve.start_weight}, end{curve.end, curve.end_weight};
    open[count++] = {0, 1, start, end, from_within, to_within, 0};
    while (count > 0) {
      const Range range = open[--count];
      const Polar control = range.depth == 0 ? Polar{curve.control, curve.weight}
                                             : polar(curve, range.from, range.to);
      const int changes = sign_changes(range, control);
      if (changes == 0) continue;
      if (changes == 1 || range.depth == kDeepest || ++ranges > kMostRanges) {
        if (range.from_within != range.to_within) add_root(curve, range, is_below);
        continue;
      }
      const double middle = 0.5 * (range.from + range.to);
      const Polar at = polar(curve, middle, middle);
      const bool is_within =
          side(within_curve(at.point, at.point), rounding(at.point), range.from_within);
      const int depth = range.depth + 1;
      open[count++] = {middle, range.to, at, range.end, is_within, range.to_within, depth};
      open[count++] = {range.from, middle, range.start, at, range.from_within, is_within, depth};
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
    double value, growth;
  };
  Quartic quartic(const Curve& curve, double s) const {
    const double a = (1 - s) * (1 - s) * curve.start_weight, b = 2 * (1 - s) * s * curve.weight,
                 c = s * s * curve.end_weight;
    const double da = -2 * (1 - s) * curve.start_weight, db = 2 * (1 - 2 * s) * curve.weight,
                 dc = 2 * s * curve.end_weight;
    const double weight = a + b + c, weight_growth = da + db + dc;
    const auto sum = [](double start, double control, double end, double u, double v, double w) {
      return u * start + v * control + w * end;
    };
    const auto& [start, control, end, w0, w1, w2] = curve;
    const double beyond = sum(start.beyond, control.beyond, end.beyond, a, b, c);
    const double beyond_growth = sum(start.beyond, control.beyond, end.beyond, da, db, dc);
    const double run = sum(start.run, control.run, end.run, a, b, c);
    const double run_growth = sum(start.run, control.run, end.run, da, db, dc);
    const double rise2 = path_.rise * path_.rise;
    return {rise2 * beyond * (beyond + 2 * path_.offset * weight) - run * run,
            2 * (rise2 * (beyond * beyond_growth +
                          path_.offset * (beyond_growth * weight + beyond * weight_growth)) -
                 run * run_growth)};
  }

  /// Returns where the quartic's chord over a range is 0, but not close to its ends, where the
  /// quartic may be 0 for all that can be told.
  double first_guess(const Curve& curve, const Range& range) const {
    const double start = quartic(curve, range.from).value, end = quartic(curve, range.to).value;
    const double share = start / (start - end);
    constexpr double kLeastShare = 0x1p-5;
    const bool is_inside = share > kLeastShare && share < 1 - kLeastShare;
    return range.from + (range.to - range.from) * (is_inside ? share : 0.5);
  }

  /// Adds the only root in a range, by Newton's method between bounds.
  void add_root(const Curve& curve, const Range& range, bool is_below) const {
    double from = range.from, to = range.to;
    double s = range.to_within ? to : from;
    constexpr int kMostSteps = 200, kQuickSteps = 12;
    constexpr double kLeastStep = 0x1p-54;
    // Where steps shrink faster than this share, as they do next to a root that is no touch, they
    // do so by more from one to the next, and one that follows a small one is less than a rounding.
    constexpr double kFastShare = 0x1p-10, kSmallStep = 0x1p-40;
    double last_step = 1;
    // A level path is met at its middle.
    if (path_.rise != 0) s = first_guess(curve, range);
    for (int step = 0; path_.rise != 0 && step < kMostSteps; ++step) {
      const auto [value, growth] = quartic(curve, s);
      (value > 0) == range.from_within ? from = s : to = s;
      double next = s - value / growth;
      const double size = std::abs(next - s);
      const bool is_last =
          size <= kLeastStep || (size <= kSmallStep && size <= kFastShare * last_step);
      last_step = size;
      if (is_last) {
        next = std::clamp(next, range.from, range.to);
      } else if (!(next > from && next < to) || step % kQuickSteps == kQuickSteps - 1) {
        next = 0.5 * (from + to);
      }
      const bool is_end = next == from || next == to;
      s = next;
      if (is_last || is_end) break;
    }
    const CurvePoint point = polar(curve, s, s).point;
    const double across = std::sqrt(std::max(0.0, across2(point)));
    const double rho = is_below == (path_.upwards() > 0) ? -across : across;
    const double r = point.beyond + path_.offset;
    // The height of the point and its ρ both tell τ. Its error in the one case is a rounding over
    // the rise. In the other it is that over how fast r grows, but not more than a rounding's root.
    const double growth = std::max(across, kLeastGrowth * r) * path_.run;
    const bool by_height = std::abs(path_.rise) * r >= growth;
    passage_.add(by_height ? point.height / path_.rise : (rho - path_.start) / path_.run,
                 range.to_within ? 1 : -1);
  }

  const PiecePassage& passage_;
  const RevolutionPath& path_;
};

double sign(double x) { return x < 0 ? -1 : 1; }

/// The polar form of the function that is > 0 within the path.
double within(const RevolutionPath& path, const PathPoint& a, const PathPoint& b) {
  return path.rise * path.rise * (a.r * b.r - path.offset * path.offset) - a.run * b.run;
}
double within(const RevolutionPath& path, const PathPoint& p) {
  return path.rise * path.rise * ((p.r - path.offset) * (p.r + path.offset)) - p.run * p.run;
}

/// Adds the crossings of the path with the curve.
void cross_curve(const PiecePassage& passage, const PathCurve& curve) {
  CurveCrosser(passage).cross(curve);
}

class PieceCrosser {
 public:
  PieceCrosser(const Profile& profile, const RevolutionPath& path, uint32_t face,
               std::vector<Crossing>& found)
      : profile_(profile), path_(path), passage_{path, face, found} {}

  void cross(const Profile::Piece& piece) {
    const PathPoint start = seen(piece.start), end = seen(piece.end);
    const bool from_within = within(path_, start) > 0, to_within = within(path_, end) > 0;
    if (piece.is_line()) {
      cross_line(start, end, from_within, to_within);
    } else {
      cross_curve(passage_,
                  {start, seen(piece.control), end, piece.weight, from_within, to_within});
    }
  }

 private:
  PathPoint seen(const Vec2& place) const { return seen(radius_at(profile_, place.x), place.y); }
  PathPoint seen(double r, double z) const {
    const double height = height_above(z, path_.height);
    return {r, height, path_.rise * path_.start + height * path_.run};
  }

  void add(double tau, int change) { passage_.add(tau, change); }

  /// A line makes a cone, whose radius at τ is (q + κ·τ)/Δz, and which a ray meets at the roots of
  /// a·τ² + 2h·τ + c. As for frusta, h² − a·c is formed without the products that would cancel.
  void cross_line(const PathPoint& start, const PathPoint& end, bool from_within, bool to_within) {
    const double rise = end.height - start.height, growth = end.r - start.r;
    if (from_within != to_within && rise == 0) {
      add(start.height / path_.rise, to_within ? 1 : -1);
      return;
    }
    // What lies within the path is convex.
    if (from_within && to_within) return;
    const bool is_pair = from_within == to_within;
    if (is_pair && !(within(path_, start, end) > 0)) return;
    const double kappa = path_.rise * growth;
    const double q = start.r * rise - growth * start.height;
    const double lean = q * path_.run - kappa * path_.start;
    const double turned = path_.offset * kappa, level = path_.offset * rise * path_.run;
    const double discriminant = lean * lean + (turned - level) * (turned + level);
    if (is_pair && !(discriminant > 0)) return;
    const double root = std::abs(rise) * std::sqrt(std::max(0.0, discriminant));
    const double steep = path_.run * rise;
    const double a = (steep - kappa) * (steep + kappa);
    const double h = steep * rise * path_.start - q * kappa;
    const double size =
        rise * rise * (path_.offset * path_.offset + path_.start * path_.start) + q * q;
    const double c = rise * rise * path_.offset * path_.offset +
                     (rise * path_.start - q) * (rise * path_.start + q);
    const auto add_root = [&](int change) {
      // The ray leaves the cone outwards at the larger root if a > 0.
      const double outwards = -change * path_.upwards() * sign(rise);
      const double own = -h + outwards * root, other = -h - outwards * root;
      // If the root nearly cancels h, the other form of it is exact, unless both are mere rounding,
      // as for a level ray that touches the cone.
      const bool cancels = h * outwards > 0 && 2 * root > std::abs(h) && root < 2 * std::abs(h) &&
                           h * h > kEpsilon * std::abs(a) * size;
      const double tau = cancels ? c / other : own / a;
      if (path_.rise == 0) return add(tau, change);
      // Along the cone, a ray passes it somewhere between the edge's ends.
      const auto [low, high] = std::minmax({start.height / path_.rise, end.height / path_.rise});
      add(std::isnan(tau) ? low : std::clamp(tau, low, high), change);
    };
    if (is_pair || to_within) add_root(1);
    if (is_pair || from_within) add_root(-1);
  }

  const Profile& profile_;
  const RevolutionPath& path_;
  PiecePassage passage_;
};

}  // namespace

void cross_piece(const Profile& profile, const RevolutionPath& path, const Profile::Piece& piece,
                 uint32_t face, std::vector<Crossing>& found) {
  PieceCrosser(profile, path, face, found).cross(piece);
}

}  // namespace csgcore
