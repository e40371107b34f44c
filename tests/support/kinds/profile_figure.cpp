#include "kinds/profile_figure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace csgcore::reference {
namespace {

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

Real cross(const LongVec2& a, const LongVec2& b) { return a.x * b.y - a.y * b.x; }

FigureEdge make_edge(const LongVec2& start, const ProfileEdge& edge) {
  FigureEdge made{edge.kind,
                  edge.is_counterclockwise,
                  start,
                  LongVec2(edge.control),
                  LongVec2(edge.end),
                  0,
                  0,
                  0,
                  0,
                  0};
  const LongVec2 control = made.control - start, end = made.end - start;
  switch (edge.kind) {
    case ProfileEdge::Kind::kLine:
      made.control = start;
      made.u = -end.y, made.v = end.x;
      break;
    case ProfileEdge::Kind::kArc:
      made.uu = made.vv = 1;
      made.u = -2 * control.x, made.v = -2 * control.y;
      break;
    case ProfileEdge::Kind::kBezier: {
      // With the shares a, b, c of the three points the curve is b² = 4ac.
      const LongVec2 bend = end - Real(2) * control;
      const Real area = 4 * cross(control, end);
      made.uu = bend.y * bend.y, made.uv = -2 * bend.x * bend.y, made.vv = bend.x * bend.x;
      made.u = area * control.y, made.v = -area * control.x;
      break;
    }
  }
  return made;
}

/// Returns by how much the part between chord and curve changes the winding number of a point.
int bulge(const FigureEdge& edge, const LongVec2& point) {
  const LongVec2 p = point - edge.start;
  const LongVec2 chord = edge.end - edge.start;
  const Real beside = cross(chord, p);
  const Real within =
      edge.uu * p.x * p.x + edge.uv * p.x * p.y + edge.vv * p.y * p.y + edge.u * p.x + edge.v * p.y;
  if (edge.is_line() || !(within < 0)) return 0;
  const bool is_left = edge.kind == ProfileEdge::Kind::kArc
                           ? !edge.is_counterclockwise
                           : cross(edge.end - edge.start, edge.control - edge.start) > 0;
  // On the chord the polygon takes the point for one further right, or above: so that the axis may
  // bound a figure that is revolved.
  const bool is_further = chord.y < 0 || (chord.y == 0 && chord.x > 0);
  const bool is_beside = beside > 0 || (beside == 0 && is_further);
  if (is_beside != is_left) return 0;
  // A curve that bulges to the left of its chord goes around the part clockwise.
  return is_left ? -1 : 1;
}

}  // namespace

LongVec2 FigureEdge::at(Real s) const {
  switch (kind) {
    case ProfileEdge::Kind::kLine:
      return glm::mix(start, end, s);
    case ProfileEdge::Kind::kArc: {
      const LongVec2 from = start - control, to = end - control;
      Real angle = std::atan2(cross(from, to), glm::dot(from, to));
      if ((angle > 0) != is_counterclockwise)
        angle = std::copysign(std::numbers::pi_v<Real>, -angle);
      const Real c = std::cos(s * angle), sine = std::sin(s * angle);
      return control + LongVec2(c * from.x - sine * from.y, sine * from.x + c * from.y);
    }
    case ProfileEdge::Kind::kBezier:
      return glm::mix(glm::mix(start, control, s), glm::mix(control, end, s), s);
  }
  return start;
}

LongVec2 FigureEdge::gradient(const LongVec2& point) const {
  const LongVec2 p = point - start;
  return {2 * uu * p.x + uv * p.y + u, uv * p.x + 2 * vv * p.y + v};
}

LongVec2 FigureEdge::nearest(const LongVec2& point) const {
  const LongVec2 chord = end - start;
  const LongVec2 nearest_end = glm::length(point - start) < glm::length(point - end) ? start : end;
  if (is_line()) {
    const Real share = glm::dot(point - start, chord) / glm::dot(chord, chord);
    return start + std::clamp<Real>(share, 0, 1) * chord;
  }
  if (kind == ProfileEdge::Kind::kArc) {
    const LongVec2 out = point - control;
    if (glm::length(out) == 0) return nearest_end;
    const LongVec2 on = control + glm::length(start - control) / glm::length(out) * out;
    const bool is_on = (cross(chord, on - start) < 0) == is_counterclockwise;
    return is_on ? on : nearest_end;
  }
  // Where the derivative of the squared distance is 0, or at an end.
  const LongVec2 away = start - point, first = control - start, bend = end - control - first;
  const Polynomial slope{glm::dot(away, first), glm::dot(away, bend) + 2 * glm::dot(first, first),
                         3 * glm::dot(first, bend), glm::dot(bend, bend), 0};
  std::vector<Real> parameters{0, 1};
  append_splits(slope, 3, 0, 1, parameters);
  const auto distance = [&](Real s) { return glm::length(at(s) - point); };
  return at(*std::ranges::min_element(parameters, {}, distance));
}

Real FigureEdge::furthest(const LongVec2& direction) const {
  Real result = std::max(glm::dot(direction, start), glm::dot(direction, end));
  if (kind == ProfileEdge::Kind::kArc && glm::length(direction) > 0) {
    const Real radius = glm::length(start - control);
    const LongVec2 on = control + radius / glm::length(direction) * direction;
    const bool is_on = (cross(end - start, on - start) < 0) == is_counterclockwise;
    if (is_on) result = std::max(result, glm::dot(direction, on));
  }
  if (kind == ProfileEdge::Kind::kBezier) {
    const Real first = glm::dot(direction, control - start);
    const Real last = glm::dot(direction, end - control);
    const Real s = first / (first - last);
    if (s > 0 && s < 1) result = std::max(result, glm::dot(direction, at(s)));
  }
  return result;
}

Figure::Figure(const Profile& profile) : fill_rule_(profile.fill_rule()) {
  for (const ProfileLoop& loop : profile.loops()) {
    LongVec2 start(loop.back().end);
    for (const ProfileEdge& edge : loop) {
      edges_.push_back(make_edge(start, edge));
      start = edges_.back().end;
    }
  }
  max_ = {furthest({1, 0}), furthest({0, 1})};
  min_ = {-furthest({-1, 0}), -furthest({0, -1})};
}

Real Figure::furthest(const LongVec2& direction) const {
  Real result = -kInfinity;
  for (const FigureEdge& edge : edges_) result = std::max(result, edge.furthest(direction));
  return result;
}

bool Figure::contains(const LongVec2& point) const {
  int winding = 0;
  for (const FigureEdge& edge : edges_) {
    winding += bulge(edge, point);
    const bool starts_below = edge.start.y <= point.y, ends_below = edge.end.y <= point.y;
    if (starts_below == ends_below) continue;
    const Real beside = cross(edge.end - edge.start, point - edge.start);
    if (starts_below ? beside > 0 : beside < 0) winding += starts_below ? 1 : -1;
  }
  return fill_rule_ == FillRule::kNonZero ? winding != 0 : winding % 2 != 0;
}

namespace {

bool is_on_axis(const FigureEdge& edge) {
  return edge.is_line() && edge.start.x == 0 && edge.end.x == 0;
}

}  // namespace

Figure::Place Figure::nearest(const LongVec2& point, bool without_axis) const {
  Place best{0, {}, kInfinity, {}};
  for (size_t i = 0; i < edges_.size(); ++i) {
    if (without_axis && is_on_axis(edges_[i])) continue;
    const LongVec2 candidate = edges_[i].nearest(point);
    const Real distance = glm::length(candidate - point);
    if (distance < best.outside) best = {i, candidate, distance, {}};
  }
  const Real near = Real(1e-8) * size();
  LongVec2 normal = glm::normalize(edges_[best.edge].gradient(best.point));
  // Next to an edge its normal tells the side; a point beside the middle of the edge asks.
  const LongVec2 middle = edges_[best.edge].at(Real(0.4967));
  const LongVec2 normal_there = glm::normalize(edges_[best.edge].gradient(middle));
  if (contains(middle + near * normal_there)) normal = -normal;
  if (best.outside > near) {
    const Real sign = contains(point) ? -1 : 1;
    best.outwards = sign / best.outside * (point - best.point);
    best.outside *= sign;
  } else {
    best.outwards = normal;
    const Real along = glm::dot(point - best.point, normal);
    best.outside = std::copysign(best.outside, along);
  }
  return best;
}

LongVec2 Figure::edge_point(std::mt19937& random, bool without_axis) const {
  for (;;) {
    const FigureEdge& edge = edges_[random() % edges_.size()];
    if (without_axis && is_on_axis(edge)) continue;
    if (random() % 4 == 0) return edge.end;
    return edge.at(std::uniform_real_distribution<double>(0, 1)(random));
  }
}

LongVec2 Figure::random_point(std::mt19937& random) const {
  std::uniform_real_distribution<double> share(0, 1);
  for (;;) {
    const double u = share(random), v = share(random);
    const LongVec2 point = glm::mix(min_, max_, LongVec2(u, v));
    if (contains(point)) return point;
  }
}

void append_splits(const Polynomial& polynomial, int degree, Real low, Real high,
                   std::vector<Real>& splits) {
  while (degree > 0 && polynomial[size_t(degree)] == 0) --degree;
  if (degree == 0) return;
  if (degree == 1) {
    const Real root = -polynomial[0] / polynomial[1];
    if (root > low && root < high) splits.push_back(root);
    return;
  }
  Polynomial derivative{};
  for (int i = 1; i <= degree; ++i) derivative[size_t(i - 1)] = Real(i) * polynomial[size_t(i)];
  std::vector<Real> ends{low};
  append_splits(derivative, degree - 1, low, high, ends);
  std::sort(ends.begin(), ends.end());
  ends.push_back(high);
  splits.insert(splits.end(), ends.begin() + 1, ends.end() - 1);
  const auto at = [&](Real t) {
    Real value = 0;
    for (int i = degree; i >= 0; --i) value = value * t + polynomial[size_t(i)];
    return value;
  };
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    Real from = ends[i], to = ends[i + 1];
    const bool starts_positive = at(from) > 0;
    if (starts_positive == (at(to) > 0)) continue;
    constexpr int kSteps = 72;
    for (int step = 0; step < kSteps; ++step) {
      const Real middle = from + (to - from) / 2;
      ((at(middle) > 0) == starts_positive ? from : to) = middle;
    }
    splits.push_back(from + (to - from) / 2);
  }
}

}  // namespace csgcore::reference
