#include "plane/figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "heal/matrix_healing.hpp"

namespace frontend {
namespace {

using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

constexpr double kTurn = 2 * std::numbers::pi;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

ProfileEdge line_to(const Vec2& end) {
  ProfileEdge edge;
  edge.end = end;
  return edge;
}

/// The angle that an arc turns by, in radians: positive if it runs counterclockwise.
double sweep_of(const Vec2& start, const ProfileEdge& arc) {
  const Vec2 from = start - arc.control;
  const Vec2 to = arc.end - arc.control;
  double angle = std::atan2(cross(from, to), glm::dot(from, to));
  if (arc.is_counterclockwise && angle <= 0) angle += kTurn;
  if (!arc.is_counterclockwise && angle >= 0) angle -= kTurn;
  return angle;
}

Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

Vec2 bezier_point(const Vec2& start, const ProfileEdge& curve, double t) {
  return (1 - t) * (1 - t) * start + 2 * t * (1 - t) * curve.control + t * t * curve.end;
}

/// Returns how many chords a quadratic Bézier curve has, at equal steps of its parameter. Each is
/// as far from the curve as those of a circle's arc are that is as long and turns as much.
int chords_of_bezier(const Vec2& start, const ProfileEdge& curve) {
  const Vec2 before = curve.control - start;
  const Vec2 after = curve.end - curve.control;
  const double length = glm::length(before) + glm::length(after);
  if (!(length > 0)) return 1;
  const double turn = std::abs(std::atan2(cross(before, after), glm::dot(before, after)));
  // A chord of an arc that turns by a is a²/8 of the radius away from it. One of n chords of the
  // curve is a quarter of its second difference, divided by n², away.
  constexpr double kTurnOfChord = kTurn / kChordsOfCircle;
  const double share = glm::length(after - before) / length;
  const double chords = std::sqrt(2 * share * turn) / kTurnOfChord;
  return std::clamp(static_cast<int>(std::ceil(chords)), 1, kChordsOfCircle / 2);
}

/// Calls visit(point) for the points on the edge after its start, among them its end.
template <typename Visit>
void visit_chords(const Vec2& start, const ProfileEdge& edge, const Visit& visit) {
  if (edge.kind == ProfileEdge::Kind::kArc) {
    const double sweep = sweep_of(start, edge);
    const int count = static_cast<int>(std::ceil(std::abs(sweep) / kTurn * kChordsOfCircle));
    for (int i = 1; i < count; ++i) {
      visit(edge.control + turned(start - edge.control, sweep * i / count));
    }
  }
  if (edge.kind == ProfileEdge::Kind::kBezier) {
    const int count = chords_of_bezier(start, edge);
    for (int i = 1; i < count; ++i) {
      const double t = static_cast<double>(i) / count;
      visit(bezier_point(start, edge, t));
    }
  }
  visit(edge.end);
}

/// Merges the points where the curve turns back in x or in y.
void merge_turns(const Vec2& start, const ProfileEdge& curve, Rectangle& box) {
  const Vec2 before = start - curve.control;
  const Vec2 bend = before + (curve.end - curve.control);
  for (int axis = 0; axis < 2; ++axis) {
    const double t = before[axis] / bend[axis];
    if (t > 0 && t < 1) box.merge(bezier_point(start, curve, t));
  }
}

/// Calls visit(start, edge) for each edge.
template <typename Visit>
void visit_edges(const ProfileLoop& loop, const Visit& visit) {
  if (loop.empty()) return;
  Vec2 start = loop.back().end;
  for (const ProfileEdge& edge : loop) {
    visit(start, edge);
    start = edge.end;
  }
}

Polygon chords_of(const ProfileLoop& loop) {
  Polygon polygon;
  visit_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) {
    visit_chords(start, edge, [&](const Vec2& point) { polygon.push_back(point); });
  });
  return polygon;
}

bool is_line(const ProfileEdge& edge) { return edge.kind == ProfileEdge::Kind::kLine; }

Outline mapped(const PlaneMap& map, const Outline& outline) {
  Outline result = outline;
  const bool keeps = keeps_circles(map);
  const bool mirrors = map.determinant() < 0;
  for (ProfileLoop& loop : result.loops) {
    if (!keeps && std::any_of(loop.begin(), loop.end(), [](const ProfileEdge& edge) {
          return edge.kind == ProfileEdge::Kind::kArc;
        })) {
      const Polygon polygon = chords_of(loop);
      loop.clear();
      for (const Vec2& point : polygon) loop.push_back(line_to(point));
    }
    for (ProfileEdge& edge : loop) {
      edge.end = map.point(edge.end);
      edge.control = map.point(edge.control);
      edge.is_counterclockwise = edge.is_counterclockwise != mirrors;
    }
  }
  return result;
}

/// Where an arc crosses the line x = 0: the angles from its start, in the order of the way.
std::vector<double> axis_crossings(const Vec2& start, const ProfileEdge& arc) {
  const Vec2 from = start - arc.control;
  const double radius = glm::length(from);
  std::vector<double> result;
  if (!(std::abs(arc.control.x) < radius)) return result;
  const double sweep = sweep_of(start, arc);
  const double first = std::atan2(from.y, from.x);
  const double half = std::acos(-arc.control.x / radius);
  for (const double at : {half, -half}) {
    double angle = std::remainder(at - first, kTurn);
    if (sweep > 0 && angle <= 0) angle += kTurn;
    if (sweep < 0 && angle >= 0) angle -= kTurn;
    if (std::abs(angle) < std::abs(sweep)) result.push_back(angle);
  }
  std::sort(result.begin(), result.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  return result;
}

/// Moves what lies left of the axis x = 0 onto it. That changes no winding number right of it.
class RightHalf {
 public:
  explicit RightHalf(const ProfileLoop& loop) {
    visit_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) { add(start, edge); });
  }
  ProfileLoop take() { return std::move(result_); }

 private:
  void add(const Vec2& start, const ProfileEdge& edge) {
    if (edge.kind == ProfileEdge::Kind::kArc) {
      Vec2 at = start;
      for (const double angle : axis_crossings(start, edge)) {
        Vec2 crossing = edge.control + turned(start - edge.control, angle);
        crossing.x = 0;
        add_arc(at, crossing, edge);
        at = crossing;
      }
      add_arc(at, edge.end, edge);
    } else {
      Vec2 at = start;
      visit_chords(start, edge, [&](const Vec2& point) {
        add_line(at, point);
        at = point;
      });
    }
  }

  /// An arc that does not cross the axis.
  void add_arc(const Vec2& start, const Vec2& end, const ProfileEdge& whole) {
    ProfileEdge part = whole;
    part.end = end;
    const Vec2 middle = whole.control + turned(start - whole.control, sweep_of(start, part) / 2);
    if (middle.x > 0) {
      part.end.x = std::max(part.end.x, 0.0);
      result_.push_back(part);
    } else {
      result_.push_back(line_to({0, end.y}));
    }
  }

  void add_line(const Vec2& start, const Vec2& end) {
    if ((start.x < 0 && end.x > 0) || (start.x > 0 && end.x < 0)) {
      const double t = start.x / (start.x - end.x);
      result_.push_back(line_to({0, start.y + t * (end.y - start.y)}));
    }
    result_.push_back(line_to({std::max(end.x, 0.0), end.y}));
  }

  ProfileLoop result_;
};

/// Returns the polygon without points that equal a neighbour, or lie on the line through both
/// neighbours.
Polygon without_straight_corners(const Polygon& polygon) {
  const auto is_straight = [](const Vec2& before, const Vec2& at, const Vec2& after) {
    return cross(at - before, after - at) == 0;
  };
  Polygon kept;
  for (const Vec2& point : polygon) {
    while (kept.size() >= 2 && is_straight(kept[kept.size() - 2], kept.back(), point)) {
      kept.pop_back();
    }
    if (kept.empty() || kept.back() != point) kept.push_back(point);
  }
  size_t first = 0;
  while (kept.size() - first >= 3) {
    if (is_straight(kept[kept.size() - 2], kept.back(), kept[first])) {
      kept.pop_back();
    } else if (is_straight(kept.back(), kept[first], kept[first + 1])) {
      ++first;
    } else {
      break;
    }
  }
  return Polygon(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
}

}  // namespace

void Rectangle::merge(const Vec2& point) {
  min = {std::min(min.x, point.x), std::min(min.y, point.y)};
  max = {std::max(max.x, point.x), std::max(max.y, point.y)};
}

void Rectangle::merge(const Rectangle& other) {
  if (other.empty()) return;
  merge(other.min);
  merge(other.max);
}

Polygon circle_polygon(const Disc& disc, int fragments) {
  Polygon polygon;
  for (int i = 0; i < fragments; ++i) {
    const double angle = 360.0 * i / fragments;
    polygon.push_back(disc.center + disc.radius * Vec2(cos_deg(angle), sin_deg(angle)));
  }
  return polygon;
}

Outline outline_of(Polygons polygons, csgcore::FillRule fill_rule) {
  Outline outline;
  outline.fill_rule = fill_rule;
  for (const Polygon& polygon : polygons) {
    ProfileLoop& loop = outline.loops.emplace_back();
    for (const Vec2& point : polygon) loop.push_back(line_to(point));
  }
  return outline;
}

Outline outline_of(const Disc& disc) {
  Outline outline;
  ProfileLoop& loop = outline.loops.emplace_back();
  for (const double side : {1.0, -1.0}) {
    ProfileEdge arc;
    arc.kind = ProfileEdge::Kind::kArc;
    arc.control = disc.center;
    arc.end = disc.center + Vec2(0, side * disc.radius);
    loop.push_back(arc);
  }
  return outline;
}

Outline outline_of(const Figure& figure) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) return outline_of(*disc);
  return std::get<Outline>(figure);
}

Polygons chords_of(const Figure& figure) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    return {circle_polygon(*disc, kChordsOfCircle)};
  }
  Polygons result;
  for (const ProfileLoop& loop : std::get<Outline>(figure).loops) {
    result.push_back(chords_of(loop));
  }
  return result;
}

bool is_polygonal(const Figure& figure) {
  const Outline* outline = std::get_if<Outline>(&figure);
  return outline != nullptr &&
         std::all_of(outline->loops.begin(), outline->loops.end(), [](const ProfileLoop& loop) {
           return std::all_of(loop.begin(), loop.end(), is_line);
         });
}

Figure mapped(const PlaneMap& map, const Figure& figure) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    if (keeps_circles(map)) {
      return Disc{map.point(disc->center), disc->radius * glm::length(map.linear[0])};
    }
    return mapped(map, outline_of(*disc));
  }
  return mapped(map, std::get<Outline>(figure));
}

Rectangle bounds_of(const Figure& figure) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    return {disc->center - disc->radius, disc->center + disc->radius};
  }
  Rectangle result;
  for (const ProfileLoop& loop : std::get<Outline>(figure).loops) {
    visit_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) {
      result.merge(edge.end);
      if (edge.kind == ProfileEdge::Kind::kBezier) merge_turns(start, edge, result);
      if (edge.kind != ProfileEdge::Kind::kArc) return;
      const double radius = glm::length(start - edge.control);
      const double first = std::atan2(start.y - edge.control.y, start.x - edge.control.x);
      const double sweep = sweep_of(start, edge);
      for (const Vec2& way : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
        double angle = std::remainder(std::atan2(way.y, way.x) - first, kTurn);
        if (sweep > 0 && angle < 0) angle += kTurn;
        if (sweep < 0 && angle > 0) angle -= kTurn;
        if (std::abs(angle) <= std::abs(sweep)) result.merge(edge.control + radius * way);
      }
    });
  }
  return result;
}

Rectangle bounds_of(std::span<const Polygon> polygons) {
  Rectangle result;
  for (const Polygon& polygon : polygons) {
    for (const Vec2& point : polygon) result.merge(point);
  }
  return result;
}

std::optional<Polygon> convex_corners(const Figure& figure) {
  const Outline* outline = std::get_if<Outline>(&figure);
  if (outline == nullptr || outline->loops.size() != 1 || !is_polygonal(figure)) {
    return std::nullopt;
  }
  Polygon polygon = without_straight_corners(chords_of(outline->loops.front()));
  if (polygon.size() < 3) return std::nullopt;
  // All corners turn the same way, and all of them together once.
  double turned_by = 0;
  bool turns_left = false, turns_right = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 before = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vec2 after = polygon[(i + 2) % polygon.size()] - polygon[(i + 1) % polygon.size()];
    const double sine = cross(before, after);
    (sine > 0 ? turns_left : turns_right) = true;
    turned_by += std::atan2(sine, glm::dot(before, after));
  }
  if (turns_left == turns_right || std::abs(turned_by) > 1.5 * kTurn) return std::nullopt;
  if (turns_right) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Outline right_half(const Figure& figure) {
  Outline outline = outline_of(figure);
  for (ProfileLoop& loop : outline.loops) loop = RightHalf(loop).take();
  return outline;
}

}  // namespace frontend
