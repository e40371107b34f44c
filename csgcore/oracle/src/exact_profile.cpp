#include "exact_profile.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "box_tree.hpp"

namespace oracle {
namespace {

using csgcore::ProfileEdge;
using csgcore::Vec2;
using Kind = ProfileEdge::Kind;
using Index = unsigned long long;

/// What boxes in doubles allow for rounding, as a share of the figure's or the solid's size.
constexpr double kFigureSlack = 1e-7;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns whether the circle's point in a direction from its centre is on the arc, up to rounding.
bool is_on_arc(const Vec2& start, const ProfileEdge& edge, const Vec2& direction) {
  const double radius = glm::length(start - edge.control);
  const Vec2 on = edge.control + radius / glm::length(direction) * direction;
  return (cross(edge.end - start, on - start) < 0) == edge.is_counterclockwise;
}

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

template <class Visit>
void for_each_edge(const csgcore::Profile& profile, const Visit& visit) {
  for (const csgcore::ProfileLoop& loop : profile.loops()) {
    Vec2 start = loop.back().end;
    for (const ProfileEdge& edge : loop) {
      visit(start, edge);
      start = edge.end;
    }
  }
}

Interval range_of(const Vec2& start, const ProfileEdge& edge, const Interval& x,
                  const Interval& y) {
  const auto along = [&](const Vec2& p) { return x * Interval(p.x) + y * Interval(p.y); };
  Interval range = hull(along(start), along(edge.end));
  const Vec2 direction(middle(x), middle(y));
  if (edge.kind == Kind::kArc && direction != Vec2(0.0)) {
    const Interval dx = Interval(start.x) - Interval(edge.control.x);
    const Interval dy = Interval(start.y) - Interval(edge.control.y);
    const Interval reach =
        CGAL::sqrt((CGAL::square(dx) + CGAL::square(dy)) * (CGAL::square(x) + CGAL::square(y)));
    for (const int sign : {-1, 1}) {
      if (!is_on_arc(start, edge, double(sign) * direction)) continue;
      range = hull(range, along(edge.control) + Interval(sign) * reach);
    }
  }
  if (edge.kind == Kind::kBezier) {
    const Interval first = along(edge.control) - along(start);
    const Interval last = along(edge.end) - along(edge.control);
    // At a summit the derivative is 0, from `first` to `last`.
    if (middle(first) * middle(last) < 0) {
      range = hull(range, along(start) + CGAL::square(first) / (first - last));
    }
  }
  return range;
}

// --- Polynomials ---

using Polynomial = std::vector<Exact>;

Polynomial sum(const Polynomial& a, const Polynomial& b) {
  Polynomial result(std::max(a.size(), b.size()), Exact(0));
  for (size_t i = 0; i < a.size(); ++i) result[i] += a[i];
  for (size_t i = 0; i < b.size(); ++i) result[i] += b[i];
  return result;
}

Polynomial product(const Exact& factor, const Polynomial& a) {
  Polynomial result;
  for (const Exact& coefficient : a) result.push_back(factor * coefficient);
  return result;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial result(a.size() + b.size() - 1, Exact(0));
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}

template <class Number>
Number value_at(const std::vector<Number>& polynomial, const Number& t) {
  Number value(0);
  for (size_t i = polynomial.size(); i-- > 0;) value = value * t + polynomial[i];
  return value;
}

double double_at(const Polynomial& polynomial, double t) {
  double value = 0;
  for (size_t i = polynomial.size(); i-- > 0;) {
    value = value * t + CGAL::to_double(polynomial[i]);
  }
  return value;
}

}  // namespace

Interval range_along(const csgcore::Profile& profile, const Interval& x, const Interval& y) {
  std::optional<Interval> range;
  for_each_edge(profile, [&](const Vec2& start, const ProfileEdge& edge) {
    const Interval own = range_of(start, edge, x, y);
    range = range ? hull(*range, own) : own;
  });
  return range.value_or(Interval(0));
}

/// Places t = low + k·step for k from 0 to `count`.
class ExactProfile::Grid {
 public:
  __extension__ using Number = unsigned __int128;
  static constexpr int kBits = 100;
  /// Numbers that are no further apart are one place.
  static constexpr Number kTogether = 256;

  explicit Grid(const Window& window)
      : low_(window.low),
        exponent_(std::ilogb(window.high - window.low) + 1 - kBits),
        step_(power_of_two(exponent_)) {}

  Number count() const { return Number{1} << kBits; }
  double error() const { return 2 * std::ldexp(double(kTogether), exponent_); }

  Exact t(Number k) const {
    constexpr int kPart = 40;
    constexpr Number kMask = (Number{1} << kPart) - 1;
    Exact offset = Exact(double(k & kMask));
    offset += power_of_two(kPart) * Exact(double((k >> kPart) & kMask));
    offset += power_of_two(2 * kPart) * Exact(double(k >> (2 * kPart)));
    return low_ + step_ * offset;
  }

  /// Appends the numbers next to the polynomial's roots, and `others` between which it is
  /// monotone.
  void append_roots(Polynomial polynomial, std::vector<Number>& roots,
                    std::vector<Number>& others) const {
    while (!polynomial.empty() && polynomial.back().is_zero()) polynomial.pop_back();
    if (polynomial.size() < 2) return;
    Polynomial derivative;
    for (size_t i = 1; i < polynomial.size(); ++i) {
      derivative.push_back(Exact(double(i)) * polynomial[i]);
    }
    std::vector<Number> ends{0, count()};
    append_roots(derivative, ends, others);
    others.insert(others.end(), ends.begin() + 2, ends.end());
    std::sort(ends.begin(), ends.end());
    std::vector<Interval> enclosed;
    for (const Exact& coefficient : polynomial) enclosed.push_back(enclose(coefficient));
    const auto is_positive = [&](Number k) {
      const Exact at = t(k);
      const Interval rough = value_at(enclosed, enclose(at));
      if (rough.inf() > 0) return true;
      if (rough.sup() < 0) return false;
      return value_at(polynomial, at).sign() > 0;
    };
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      Number from = ends[i], to = ends[i + 1];
      const bool starts_positive = is_positive(from);
      if (starts_positive == is_positive(to)) continue;
      while (to - from > 1) {
        const Number half = from + (to - from) / 2;
        (is_positive(half) == starts_positive ? from : to) = half;
      }
      roots.push_back(from);
    }
  }

 private:
  Exact low_;
  int exponent_;
  Exact step_;
};

ExactProfile::ExactProfile(const csgcore::Primitive& primitive, const Vector<Exact>& middle,
                           const Exact& magnification)
    : is_revolution_(primitive.shape() == csgcore::Shape::kRevolution),
      fill_rule_(primitive.profile()->fill_rule()),
      middle_(middle),
      magnification_(magnification) {
  const csgcore::Profile& profile = *primitive.profile();
  const Vec2 low = profile.center() - profile.half(), high = profile.center() + profile.half();
  size_ = profile.half().x + profile.half().y;
  for_each_edge(profile, [&](const Vec2& start, const ProfileEdge& edge) {
    edges_.push_back(make_edge(start, edge));
  });
  const double lambda = CGAL::to_double(magnification);
  Vector<double> least, most;
  if (is_revolution_) {
    least = {-high.x, -high.x, low.y};
    most = {high.x, high.x, high.y};
  } else {
    const auto& extrusion = primitive.as<csgcore::ExtrusionShape>();
    const double a = extrusion.scale_bottom, b = extrusion.scale_top;
    height_ = Exact(extrusion.z_max) - Exact(extrusion.z_min);
    bottom_scale_ = a;
    growth_ = Exact(b) - Exact(a);
    bottom_ = magnification * (Exact(extrusion.z_min) - middle[2]);
    top_ = magnification * (Exact(extrusion.z_max) - middle[2]);
    for (int i = 0; i < 2; ++i) {
      least[i] = std::min(a * low[i], b * low[i]);
      most[i] = std::max(a * high[i], b * high[i]);
    }
    least[2] = extrusion.z_min;
    most[2] = extrusion.z_max;
  }
  double size = 0;
  for (int i = 0; i < 3; ++i) size += most[i] - least[i];
  for (int i = 0; i < 3; ++i) {
    const double m = CGAL::to_double(middle[i]);
    min_[i] = lambda * (least[i] - m - kFigureSlack * size);
    max_[i] = lambda * (most[i] - m + kFigureSlack * size);
  }
}

ExactProfile::Edge ExactProfile::make_edge(const Vec2& start, const ProfileEdge& edge) const {
  Edge made{};
  made.kind = edge.kind;
  Exact control[2];
  for (int i = 0; i < 2; ++i) {
    made.start[i] = start[i];
    made.chord[i] = Exact(edge.end[i]) - made.start[i];
    control[i] = Exact(edge.control[i]) - made.start[i];
    const Interval range = range_of(start, edge, Interval(i == 0), Interval(i == 1));
    made.min[i] = range.inf() - kFigureSlack * size_;
    made.max[i] = range.sup() + kFigureSlack * size_;
  }
  const Exact area = control[0] * made.chord[1] - control[1] * made.chord[0];
  if (edge.kind == Kind::kLine || (edge.kind == Kind::kBezier && area.is_zero())) {
    made.kind = Kind::kLine;
    made.u = -made.chord[1], made.v = made.chord[0];
  } else if (edge.kind == Kind::kArc) {
    made.bulges_left = !edge.is_counterclockwise;
    made.uu = made.vv = 1;
    made.u = Exact(-2) * control[0], made.v = Exact(-2) * control[1];
  } else {
    made.bulges_left = area.sign() < 0;
    const Exact bend[2] = {made.chord[0] - Exact(2) * control[0],
                           made.chord[1] - Exact(2) * control[1]};
    made.uu = bend[1] * bend[1], made.uv = Exact(-2) * bend[0] * bend[1];
    made.vv = bend[0] * bend[0];
    made.u = Exact(4) * area * control[1], made.v = Exact(-4) * area * control[0];
  }
  return made;
}

ExactProfile::Way ExactProfile::way_of(const LocalRay<Exact>& ray) const {
  const auto coordinate = [&](int i) -> Polynomial {
    return {ray.o[i] + magnification_ * middle_[i], ray.d[i]};
  };
  Way way;
  way.z = {ray.o[2], ray.d[2]};
  if (is_revolution_) {
    const Polynomial x = coordinate(0), y = coordinate(1);
    way.u = sum(product(x, x), product(y, y));
    way.v = coordinate(2);
    way.s = {magnification_};
  } else {
    way.u = product(height_, coordinate(0));
    way.v = product(height_, coordinate(1));
    way.s =
        sum({bottom_scale_ * height_ * magnification_}, product(growth_, sum(way.z, {-bottom_})));
  }
  return way;
}

ExactProfile::Polynomial ExactProfile::curve_along(const Edge& edge, const Way& way) const {
  // The form is rest + factor·U + uu·U².
  const Exact x = -edge.start[0];
  const Polynomial v = sum(way.v, product(-edge.start[1], way.s));
  const Polynomial& s = way.s;
  Polynomial rest, factor;
  if (edge.kind == Kind::kLine) {
    rest = sum(product(edge.v, v), product(edge.u * x, s));
    factor = {edge.u};
  } else {
    const Polynomial s2 = product(s, s);
    rest = sum(product(edge.vv, product(v, v)), sum(product(edge.uv * x + edge.v, product(v, s)),
                                                    product(edge.uu * x * x + edge.u * x, s2)));
    factor = sum(product(edge.uv, v), product(Exact(2) * edge.uu * x + edge.u, s));
  }
  if (!is_revolution_) {
    return sum(rest, sum(product(factor, way.u), product(edge.uu, product(way.u, way.u))));
  }
  rest = sum(rest, product(edge.uu, way.u));
  return sum(product(rest, rest), product(Exact(-1), product(product(factor, factor), way.u)));
}

std::optional<ExactProfile::Window> ExactProfile::window(const LocalRay<Exact>& ray) const {
  Window window{-kInfinity, kInfinity};
  for (int i = 0; i < 3; ++i) {
    const double o = CGAL::to_double(ray.o[i]), d = CGAL::to_double(ray.d[i]);
    if (d == 0) {
      if (o < min_[i] || o > max_[i]) return {};
      continue;
    }
    const double a = (min_[i] - o) / d, b = (max_[i] - o) / d;
    window.low = std::max(window.low, std::min(a, b));
    window.high = std::min(window.high, std::max(a, b));
  }
  if (!(window.low < window.high) || !std::isfinite(window.high - window.low)) return {};
  return window;
}

/// Returns false only if the way passes the edge's box nowhere in the window.
bool ExactProfile::may_meet(const Edge& edge, const Way& way, const Window& window) const {
  double low = window.low, high = window.high;
  const auto cut = [&](double at_low, double at_high) {
    // A linear function of these values at the window's ends must be ≥ 0.
    if (at_low >= 0 && at_high >= 0) return;
    if (at_low < 0 && at_high < 0) {
      low = kInfinity;
      return;
    }
    const double share = at_low / (at_low - at_high);
    const double at = window.low + share * (window.high - window.low);
    const double slack = kFigureSlack * (window.high - window.low);
    (at_low < 0 ? low : high) = at_low < 0 ? std::max(low, at - slack) : std::min(high, at + slack);
  };
  const auto cut_axis = [&](const Polynomial& along, int axis) {
    const double from = double_at(along, window.low), to = double_at(along, window.high);
    const double from_s = double_at(way.s, window.low), to_s = double_at(way.s, window.high);
    cut(from - edge.min[axis] * from_s, to - edge.min[axis] * to_s);
    cut(edge.max[axis] * from_s - from, edge.max[axis] * to_s - to);
  };
  cut_axis(way.v, 1);
  if (!is_revolution_) cut_axis(way.u, 0);
  if (!(low <= high)) return false;
  if (!is_revolution_) return true;
  // q is convex.
  const double s = CGAL::to_double(magnification_);
  const double a = double_at(way.u, low), b = double_at(way.u, high);
  double least = std::min(a, b);
  const double curvature = CGAL::to_double(way.u[2]), slope = CGAL::to_double(way.u[1]);
  if (curvature > 0) {
    least = std::max(0.0, double_at(way.u, std::clamp(-slope / (2 * curvature), low, high)));
  }
  const double outer = s * edge.max[0], inner = s * std::max(0.0, edge.min[0]);
  return least <= outer * outer && std::max(a, b) >= inner * inner;
}

/// Returns whether a place of an edge's curve is on the edge, or near it.
bool ExactProfile::is_at(Surface surface, const Way& way, const Exact& t) const {
  if (uint32_t(surface) < 2) return true;
  const Edge& edge = edges_[uint32_t(surface) - 2];
  const double u = CGAL::to_double(value_at(way.u, t)), v = CGAL::to_double(value_at(way.v, t));
  const double s = CGAL::to_double(value_at(way.s, t));
  const double place[2] = {(is_revolution_ ? std::sqrt(std::max(u, 0.0)) : u) / s, v / s};
  for (int i = 0; i < 2; ++i) {
    if (place[i] < edge.min[i] || place[i] > edge.max[i]) return false;
  }
  return true;
}

/// Returns the sign of rest + factor·U.
int ExactProfile::sign_at(const Place& place, const Exact& rest, const Exact& factor) const {
  if (!is_revolution_) return (rest + factor * place.u).sign();
  const int own = rest.sign(), other = place.u.is_zero() ? 0 : factor.sign();
  if (own == other || other == 0) return own;
  if (own == 0) return other;
  return own * (rest * rest - factor * factor * place.u).sign();
}

/// The rule of reference::Figure, by exact signs.
bool ExactProfile::contains(const Way& way, const Exact& t) const {
  const Place place{value_at(way.u, t), value_at(way.v, t), value_at(way.s, t)};
  if (!is_revolution_) {
    const Exact z = value_at(way.z, t);
    if ((z - bottom_).sign() < 0 || (top_ - z).sign() < 0 || place.s.sign() <= 0) return false;
  }
  const Exact u2 = is_revolution_ ? place.u : Exact(place.u * place.u);
  int winding = 0;
  for (const Edge& edge : edges_) {
    const Exact x = -edge.start[0] * place.s, v = place.v - edge.start[1] * place.s;
    const int beside = sign_at(place, edge.chord[0] * v - edge.chord[1] * x, -edge.chord[1]);
    const bool starts_below = v.sign() >= 0;
    const bool ends_below = (v - edge.chord[1] * place.s).sign() >= 0;
    if (starts_below != ends_below && beside == (starts_below ? 1 : -1)) {
      winding += starts_below ? 1 : -1;
    }
    if (edge.kind == Kind::kLine) continue;
    const int rise = edge.chord[1].sign();
    const bool is_further = rise < 0 || (rise == 0 && edge.chord[0].sign() > 0);
    if ((beside > 0 || (beside == 0 && is_further)) != edge.bulges_left) continue;
    const Exact rest = edge.uu * (u2 + x * x) + edge.uv * x * v + edge.vv * v * v +
                       place.s * (edge.u * x + edge.v * v);
    const Exact factor = Exact(2) * edge.uu * x + edge.uv * v + edge.u * place.s;
    if (sign_at(place, rest, factor) < 0) winding += edge.bulges_left ? -1 : 1;
  }
  return fill_rule_ == csgcore::FillRule::kNonZero ? winding != 0 : winding % 2 != 0;
}

std::vector<ProfileSegment> ExactProfile::segments(const LocalRay<Exact>& ray) const {
  const std::optional<Window> within = window(ray);
  if (!within) return {};
  const Way way = way_of(ray);
  const Grid grid(*within);
  /// A place where the ray may enter or leave the solid, by a surface if it is a root.
  struct Split {
    Grid::Number k;
    bool is_root;
    Surface surface;
  };
  std::vector<Split> splits;
  std::vector<Grid::Number> roots, others;
  const auto add = [&](const Polynomial& polynomial, Surface surface) {
    roots.clear(), others.clear();
    grid.append_roots(polynomial, roots, others);
    for (const Grid::Number k : roots) splits.push_back({k, true, surface});
    for (const Grid::Number k : others) splits.push_back({k, false, surface});
  };
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    if (may_meet(edges_[i], way, *within)) add(curve_along(edges_[i], way), edge_surface(i));
  }
  if (!is_revolution_) {
    add(sum(way.z, {-bottom_}), Surface::kBottom);
    add(sum(way.z, {-top_}), Surface::kTop);
  }
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) { return a.k < b.k; });
  const auto end_at = [&](size_t first, size_t last) {
    const Split* best = nullptr;
    const auto rank = [&](const Split& split) {
      return std::pair(!split.is_root || !is_at(split.surface, way, grid.t(split.k)),
                       split.surface);
    };
    for (size_t i = first; i < last; ++i) {
      if (!best || rank(splits[i]) < rank(*best)) best = &splits[i];
    }
    return ProfileEnd{best->surface, {grid.t(best->k), 0, 0, 1}, grid.error()};
  };
  std::vector<ProfileSegment> segments;
  bool is_open = false;
  for (size_t first = 0, last = 0; first < splits.size(); first = last) {
    while (last < splits.size() &&
           (last == first || splits[last].k - splits[last - 1].k <= Grid::kTogether)) {
      ++last;
    }
    const Grid::Number from = splits[last - 1].k;
    const Grid::Number to = last < splits.size() ? splits[last].k : grid.count();
    const bool is_inside = contains(way, grid.t(from + (to - from) / 2));
    if (is_inside == is_open) continue;
    const ProfileEnd end = end_at(first, last);
    if (is_inside) segments.push_back({end, end});
    if (!is_inside) segments.back().end = end;
    is_open = is_inside;
  }
  return segments;
}

Vector<Interval> ExactProfile::normal(const Vector<Interval>& point, Surface surface) const {
  if (uint32_t(surface) < 2) return {0, 0, 1};
  const Edge& edge = edges_[uint32_t(surface) - 2];
  Vector<Interval> p;
  for (int i = 0; i < 3; ++i) p[i] = point[i] + enclose(magnification_ * middle_[i]);
  const Interval radius = CGAL::sqrt(CGAL::square(p[0]) + CGAL::square(p[1]));
  const Interval height = enclose(height_), growth = enclose(growth_);
  const Interval s = is_revolution_ ? enclose(magnification_)
                                    : enclose(bottom_scale_ * height_ * magnification_) +
                                          growth * (point[2] - enclose(bottom_));
  const Interval start[2] = {enclose(edge.start[0]), enclose(edge.start[1])};
  const Interval u = (is_revolution_ ? radius : height * p[0]) - start[0] * s;
  const Interval v = (is_revolution_ ? p[2] : height * p[1]) - start[1] * s;
  const Interval eu = enclose(edge.u), ev = enclose(edge.v);
  Interval along_u = eu, along_v = ev, along_s = 0;
  if (edge.kind != Kind::kLine) {
    along_u = Interval(2) * enclose(edge.uu) * u + enclose(edge.uv) * v + eu * s;
    along_v = enclose(edge.uv) * u + Interval(2) * enclose(edge.vv) * v + ev * s;
    along_s = eu * u + ev * v;
  }
  if (!is_revolution_) {
    along_s -= start[0] * along_u + start[1] * along_v;
    return {height * along_u, height * along_v, growth * along_s};
  }
  if (middle(radius) == 0) return {0, 0, 1};
  return {along_u * p[0], along_u * p[1], along_v * radius};
}

}  // namespace oracle
