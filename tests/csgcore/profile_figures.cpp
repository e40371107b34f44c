#include "profile_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "checks.hpp"

namespace csgcore::checks {
namespace {

using Kind = ProfileEdge::Kind;

/// A part of an edge along which y grows or falls: x and y by a parameter.
struct Monotone {
  std::function<Real(Real)> x, y;
  Real from, to;
  Real from_y, to_y;  // exact at the edge's ends
};

std::vector<Monotone> parts_of(const Vec2& start, const ProfileEdge& edge) {
  std::function<Real(Real)> x, y;
  std::vector<Real> cuts{0};
  switch (edge.kind) {
    case Kind::kLine:
      x = [=](Real s) { return start.x + s * (Real(edge.end.x) - start.x); };
      y = [=](Real s) { return start.y + s * (Real(edge.end.y) - start.y); };
      break;
    case Kind::kArc: {
      const Real radius =
          std::hypot(Real(start.x) - edge.control.x, Real(start.y) - edge.control.y);
      const Real pi = std::numbers::pi_v<Real>;
      const Real first = std::atan2(Real(start.y) - edge.control.y, Real(start.x) - edge.control.x);
      Real sweep =
          std::atan2(Real(edge.end.y) - edge.control.y, Real(edge.end.x) - edge.control.x) - first;
      if (edge.is_counterclockwise && sweep < 0) sweep += 2 * pi;
      if (!edge.is_counterclockwise && sweep > 0) sweep -= 2 * pi;
      x = [=](Real s) { return edge.control.x + radius * std::cos(first + s * sweep); };
      y = [=](Real s) { return edge.control.y + radius * std::sin(first + s * sweep); };
      for (int quarter = -5; quarter <= 5; quarter += 2) {
        const Real at = (quarter * pi / 2 - first) / sweep;
        if (at > 0 && at < 1) cuts.push_back(at);
      }
      break;
    }
    case Kind::kBezier: {
      const auto value = [](Real a, Real b, Real c, Real s) {
        return (1 - s) * (1 - s) * a + 2 * s * (1 - s) * b + s * s * c;
      };
      x = [=](Real s) { return value(start.x, edge.control.x, edge.end.x, s); };
      y = [=](Real s) { return value(start.y, edge.control.y, edge.end.y, s); };
      const Real at = (Real(start.y) - edge.control.y) /
                      (Real(start.y) - 2 * Real(edge.control.y) + edge.end.y);
      if (at > 0 && at < 1) cuts.push_back(at);
      break;
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1);
  std::vector<Monotone> parts;
  for (size_t i = 1; i < cuts.size(); ++i) {
    const bool is_first = i == 1, is_last = i + 1 == cuts.size();
    parts.push_back({x, y, cuts[i - 1], cuts[i], is_first ? Real(start.y) : y(cuts[i - 1]),
                     is_last ? Real(edge.end.y) : y(cuts[i])});
  }
  return parts;
}

}  // namespace

ProfileLoop polygon(const std::vector<Vec2>& points) {
  ProfileLoop loop;
  for (const Vec2& point : points) loop.push_back({Kind::kLine, true, point, {}});
  return loop;
}

ProfileLoop circle(const Vec2& center, double radius, int arcs, bool is_counterclockwise,
                   double first_angle) {
  ProfileLoop loop;
  for (int i = 1; i <= arcs; ++i) {
    const double angle = first_angle + (is_counterclockwise ? 2 : -2) * std::numbers::pi * i / arcs;
    loop.push_back({Kind::kArc,
                    is_counterclockwise,
                    {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)},
                    center});
  }
  return loop;
}

std::vector<ProfileLoop> random_loops(std::mt19937& random, int most) {
  std::vector<ProfileLoop> loops(1 + random() % 3);
  const bool is_integer = random() % 2;
  const auto coordinate = [&] {
    const double any = uniform(random, -4, 4);
    return is_integer ? std::round(any) : any;
  };
  const int curves = static_cast<int>(random() % 3);  // none, some, many
  for (ProfileLoop& loop : loops) {
    if (random() % 6 == 0) {
      loop = circle({coordinate(), coordinate()}, 0.5 + std::abs(coordinate()),
                    2 + static_cast<int>(random() % 3), random() % 2, random() % 2);
      continue;
    }
    std::vector<Vec2> points(3 + random() % static_cast<unsigned>(most - 2));
    for (Vec2& point : points) point = {coordinate(), coordinate()};
    Vec2 start = points.back();
    for (const Vec2& end : points) {
      ProfileEdge edge{Kind::kLine, random() % 2 == 0, end, {}};
      if (end != start && static_cast<int>(random() % 3) < curves) {
        if (random() % 2) {
          edge.kind = Kind::kBezier;
          edge.control = {coordinate(), coordinate()};
        } else {
          // To the left of a counterclockwise arc of less than a half turn is its centre.
          edge.kind = Kind::kArc;
          const Vec2 chord = end - start;
          const double bulge = (edge.is_counterclockwise ? 1 : -1) * uniform(random, 0, 1);
          edge.control =
              0.5 * (start + end) + (random() % 3 == 0 ? 0 : bulge) * Vec2{-chord.y, chord.x};
        }
      }
      loop.push_back(edge);
      start = end;
    }
  }
  return loops;
}

std::vector<ProfileLoop> beside_axis(std::vector<ProfileLoop> loops, std::mt19937& random) {
  double least = 0;
  for (const ProfileLoop& loop : loops) {
    Vec2 start = loop.back().end;
    for (const ProfileEdge& edge : loop) {
      least = std::min(least, edge.end.x);
      for (const double at : {0.25, 0.5, 0.75}) {
        least = std::min(least, edge_point(start, edge, at).place.x);
      }
      if (edge.kind == Kind::kBezier) least = std::min(least, edge.control.x);
      if (edge.kind == Kind::kArc) {
        least = std::min(least, edge.control.x - glm::distance(edge.control, start));
      }
      start = edge.end;
    }
  }
  const double shift = std::ceil(-least) + static_cast<double>(random() % 2);
  for (ProfileLoop& loop : loops) {
    for (ProfileEdge& edge : loop) {
      edge.end.x += shift;
      edge.control.x += shift;
    }
  }
  return loops;
}

std::shared_ptr<const Profile> random_profile(std::mt19937& random, bool is_beside_axis) {
  std::vector<ProfileLoop> loops = random_loops(random);
  if (is_beside_axis) loops = beside_axis(loops, random);
  const FillRule fill_rule = random() % 2 ? FillRule::kEvenOdd : FillRule::kNonZero;
  auto profile = std::make_shared<Profile>(loops, fill_rule);
  return profile->has_area() ? profile : random_profile(random, is_beside_axis);
}

EdgePoint edge_point(const Vec2& start, const ProfileEdge& edge, double at) {
  if (edge.kind == Kind::kLine) return {glm::mix(start, edge.end, at), edge.end - start};
  if (edge.kind == Kind::kBezier) {
    const Vec2 before = glm::mix(start, edge.control, at),
               after = glm::mix(edge.control, edge.end, at);
    return {glm::mix(before, after, at), after - before};
  }
  const Vec2 from = start - edge.control, to = edge.end - edge.control;
  double sweep = std::atan2(to.y, to.x) - std::atan2(from.y, from.x);
  if (edge.is_counterclockwise && sweep < 0) sweep += 2 * std::numbers::pi;
  if (!edge.is_counterclockwise && sweep > 0) sweep -= 2 * std::numbers::pi;
  const double c = std::cos(at * sweep), s = std::sin(at * sweep);
  const Vec2 out{c * from.x - s * from.y, s * from.x + c * from.y};
  return {edge.control + out, Vec2{-out.y, out.x}};
}

bool holds(std::span<const ProfileLoop> loops, FillRule fill_rule, Real x, Real y) {
  int winding = 0;
  for (const ProfileLoop& loop : loops) {
    Vec2 start = loop.back().end;
    for (const ProfileEdge& edge : loop) {
      for (const Monotone& part : parts_of(start, edge)) {
        const bool rises = part.from_y <= y && part.to_y > y;
        if (!rises && !(part.to_y <= y && part.from_y > y)) continue;
        Real from = part.from, to = part.to;
        for (int i = 0; i < 70; ++i) {
          const Real middle = (from + to) / 2;
          ((part.y(middle) > y) == rises ? to : from) = middle;
        }
        if (part.x((from + to) / 2) > x) winding += rises ? 1 : -1;
      }
      start = edge.end;
    }
  }
  return fill_rule == FillRule::kEvenOdd ? winding % 2 != 0 : winding != 0;
}

namespace {

/// The point of the profile's plane that makes a local point, and the cross-section's scale there.
struct FigurePoint {
  Real x, y;  // nan at an extrusion's apex
  Real scale;
};
FigurePoint figure_point(const Primitive& primitive, const LongVec3& p) {
  if (primitive.shape() == Shape::kRevolution) return {std::hypot(p.x, p.y), p.z, 1};
  const auto& [profile, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
  const Real share = (p.z - z_min) / (Real(z_max) - z_min);
  const Real scale = bottom + share * (Real(top) - bottom);
  return {p.x / scale, p.y / scale, scale};
}

bool is_straight(const Vec2& start, const ProfileEdge& edge) {
  const Vec2 chord = edge.end - start, control = edge.control - start;
  return chord.x * control.y == chord.y * control.x;
}

}  // namespace

bool holds_local(const Primitive& primitive, const LongVec3& p) {
  const auto* const extrusion = std::get_if<ExtrusionShape>(&primitive.solid);
  if (extrusion && (p.z < extrusion->z_min || p.z > extrusion->z_max)) {
    return false;
  }
  const FigurePoint at = figure_point(primitive, p);
  return holds(primitive.profile()->loops(), primitive.profile()->fill_rule(), at.x, at.y);
}

bool is_at_edge(const Primitive& primitive, const LongVec3& p) {
  // Curves that leave a vertex side by side are apart by the square of their way from it.
  constexpr Real kNextToVertex = 1e-6, kNext = 1e-9;
  const FigurePoint at = figure_point(primitive, p);
  if (at.scale < kNextToVertex) return true;
  const auto is_next_to = [&](const Vec2& from, const Vec2& to) {
    const Real x = to.x - Real(from.x), y = to.y - Real(from.y);
    const Real along = ((at.x - from.x) * x + (at.y - from.y) * y) / (x * x + y * y);
    const Real share = along > 0 ? std::min<Real>(along, 1) : 0;
    return std::hypot(at.x - from.x - share * x, at.y - from.y - share * y) < kNext;
  };
  for (const ProfileLoop& loop : primitive.profile()->loops()) {
    Vec2 start = loop.back().end;
    for (const ProfileEdge& edge : loop) {
      if (edge.kind == Kind::kLine) {
        if (is_next_to(start, edge.end)) return true;
      } else if (edge.kind == Kind::kBezier && is_straight(start, edge)) {
        if (is_next_to(start, edge.control) || is_next_to(edge.control, edge.end)) return true;
      }
      if (std::hypot(at.x - edge.end.x, at.y - edge.end.y) < kNextToVertex) return true;
      start = edge.end;
    }
  }
  return false;
}

}  // namespace csgcore::checks
