#include "plane/figure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.hpp"
#include "language/degrees.hpp"

namespace frontend {
namespace {

using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

/// A quadratic Bézier curve, which turns by less than half a turn, has no more chords than an arc
/// of half a turn.
constexpr int kMostChordsOfBezier = kChordsOfCircle / 2;
/// The distance of a circle from its chords, in shares of the radius.
constexpr double kDistanceFromChords = 4e-5;

/// The angle that an arc turns by, in radians: positive if it runs counterclockwise.
double sweep_of(const Vec2& start, const ProfileEdge& arc) {
  const Vec2 from = start - arc.control;
  const Vec2 to = arc.end - arc.control;
  double angle = std::atan2(cross(from, to), glm::dot(from, to));
  if (arc.is_counterclockwise && angle <= 0) angle += kTurn;
  if (!arc.is_counterclockwise && angle >= 0) angle -= kTurn;
  return angle;
}

/// How many chords curves get.
struct CurveChords {
  Chords of_arcs;
  double distance;  // from a Bézier curve, at most
};

int chords_of_circle(const Chords& chords, double radius) {
  if (chords.tolerance == 0) return chords.most;
  const double half_angle = std::acos(std::max(1 - chords.tolerance / radius, -1.0));
  const double count = std::ceil(kTurn / 2 / half_angle);
  return static_cast<int>(std::clamp<double>(count, chords.fewest, chords.most));
}

/// Returns how many chords a Bézier curve needs, none of which is further away than `distance`.
int chords_of_bezier(const Vec2& start, const ProfileEdge& edge, double distance) {
  // One chord is this far away, and each of n of them a share of 1/n² of it.
  const double furthest = glm::length(start - 2.0 * edge.control + edge.end) / 4;
  if (!(furthest > distance)) return 1;
  const double count = std::ceil(std::sqrt(furthest / distance));
  return static_cast<int>(std::min(count, static_cast<double>(kMostChordsOfBezier)));
}

/// Calls visit(point) for the points on the edge after its start, among them its end.
template <typename Visit>
void visit_chords(const Vec2& start, const ProfileEdge& edge, const CurveChords& chords,
                  const Visit& visit) {
  if (edge.kind == ProfileEdge::Kind::kArc) {
    const double sweep = sweep_of(start, edge);
    const int of_circle = chords_of_circle(chords.of_arcs, glm::length(start - edge.control));
    const int count = static_cast<int>(std::ceil(std::abs(sweep) / kTurn * of_circle));
    for (int i = 1; i < count; ++i) {
      visit(edge.control + turned(start - edge.control, sweep * i / count));
    }
  }
  if (edge.kind == ProfileEdge::Kind::kBezier) {
    const int count = chords_of_bezier(start, edge, chords.distance);
    for (int i = 1; i < count; ++i) {
      const double t = static_cast<double>(i) / count;
      visit((1 - t) * (1 - t) * start + 2 * t * (1 - t) * edge.control + t * t * edge.end);
    }
  }
  visit(edge.end);
}

/// Calls visit(start, edge) for each edge.
template <typename Visit>
void visit_loop_edges(const ProfileLoop& loop, const Visit& visit) {
  if (loop.empty()) return;
  Vec2 start = loop.back().end;
  for (const ProfileEdge& edge : loop) {
    visit(start, edge);
    start = edge.end;
  }
}

/// Returns how many chords the curves of a figure get: they may be as far away as those of a circle
/// of its size.
CurveChords chords_for(const Outline& outline, const Chords& chords = {}) {
  Rectangle box;
  for (const ProfileLoop& loop : outline.loops) {
    for (const ProfileEdge& edge : loop) box.merge(edge.end);
  }
  const Vec2 size = box.max - box.min;
  const double distance = kDistanceFromChords * std::max(size.x, size.y) / 2;
  return {chords, std::max(distance, chords.tolerance)};
}

Polygon chords_of(const ProfileLoop& loop, const CurveChords& chords) {
  Polygon polygon;
  visit_loop_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) {
    visit_chords(start, edge, chords, [&](const Vec2& point) { polygon.push_back(point); });
  });
  return polygon;
}

bool is_line(const ProfileEdge& edge) { return edge.kind == ProfileEdge::Kind::kLine; }

bool has_arcs(const ProfileLoop& loop) {
  return std::any_of(loop.begin(), loop.end(),
                     [](const ProfileEdge& edge) { return edge.kind == ProfileEdge::Kind::kArc; });
}

bool has_arcs(const Outline& outline) {
  return std::any_of(outline.loops.begin(), outline.loops.end(),
                     [](const ProfileLoop& loop) { return has_arcs(loop); });
}

/// Adds the points of an arc that are furthest along the axes.
void merge_arc(const Vec2& start, const ProfileEdge& arc, Rectangle& box) {
  const double radius = glm::length(start - arc.control);
  const double first = std::atan2(start.y - arc.control.y, start.x - arc.control.x);
  const double sweep = sweep_of(start, arc);
  for (const Vec2& way : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
    double angle = std::remainder(std::atan2(way.y, way.x) - first, kTurn);
    if (sweep > 0 && angle < 0) angle += kTurn;
    if (sweep < 0 && angle > 0) angle -= kTurn;
    if (std::abs(angle) <= std::abs(sweep)) box.merge(arc.control + radius * way);
  }
}

/// Adds the points of a Bézier curve that are furthest along the axes. Its ends are in the box.
void merge_bezier(const Vec2& start, const Vec2& control, const Vec2& end, Rectangle& box) {
  for (int axis = 0; axis < 2; ++axis) {
    // Where the derivative is 0: its ends' signs differ only if the control point is beyond the
    // curve's ends.
    const double first = control[axis] - start[axis];
    const double last = end[axis] - control[axis];
    if (!(first * last < 0)) continue;
    const double t = first / (first - last);
    box.merge((1 - t) * (1 - t) * start + 2 * t * (1 - t) * control + t * t * end);
  }
}

Outline mapped(const PlaneMap& map, const Outline& outline) {
  Outline result = outline;
  const bool keeps = keeps_circles(map);
  const bool mirrors = map.determinant() < 0;
  for (ProfileLoop& loop : result.loops) {
    if (!keeps && has_arcs(loop)) {
      const Polygon polygon = chords_of(loop, chords_for(outline));
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
  RightHalf(const ProfileLoop& loop, const CurveChords& chords) : chords_(chords) {
    visit_loop_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) { add(start, edge); });
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
      visit_chords(start, edge, chords_, [&](const Vec2& point) {
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

  CurveChords chords_;
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
    polygon.push_back(disc.center + disc.radius * Vec2(language::cosine_of_degrees(angle),
                                                       language::sine_of_degrees(angle)));
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

Polygons chords_of(const Figure& figure, const Chords& chords) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    return {circle_polygon(*disc, chords_of_circle(chords, disc->radius))};
  }
  const Outline& outline = std::get<Outline>(figure);
  const CurveChords of_curves = chords_for(outline, chords);
  Polygons result;
  for (const ProfileLoop& loop : outline.loops) result.push_back(chords_of(loop, of_curves));
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
    visit_loop_edges(loop, [&](const Vec2& start, const ProfileEdge& edge) {
      result.merge(edge.end);
      if (edge.kind == ProfileEdge::Kind::kArc) merge_arc(start, edge, result);
      if (edge.kind == ProfileEdge::Kind::kBezier) {
        merge_bezier(start, edge.control, edge.end, result);
      }
    });
  }
  return result;
}

Rectangle bounds_of(const PlaneMap& map, const Figure& figure) {
  const Outline* outline = std::get_if<Outline>(&figure);
  if (outline == nullptr || has_arcs(*outline)) return bounds_of(mapped(map, figure));
  Rectangle result;
  for (const ProfileLoop& loop : outline->loops) {
    if (loop.empty()) continue;
    Vec2 start = map.point(loop.back().end);
    for (const ProfileEdge& edge : loop) {
      const Vec2 end = map.point(edge.end);
      result.merge(end);
      if (!is_line(edge)) merge_bezier(start, map.point(edge.control), end, result);
      start = end;
    }
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

size_t edge_count(std::span<const Polygon> polygons) {
  size_t count = 0;
  for (const Polygon& polygon : polygons) count += polygon.size();
  return count;
}

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    twice +=
        cross(polygon[i] - polygon.front(), polygon[(i + 1) % polygon.size()] - polygon.front());
  }
  return twice / 2;
}

std::optional<Polygon> convex_corners(const Figure& figure) {
  const Outline* outline = std::get_if<Outline>(&figure);
  if (outline == nullptr || outline->loops.size() != 1 || !is_polygonal(figure)) {
    return std::nullopt;
  }
  Polygon polygon = without_straight_corners(chords_of(figure).front());
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
  const CurveChords chords = chords_for(outline);
  for (ProfileLoop& loop : outline.loops) loop = RightHalf(loop, chords).take();
  return outline;
}

}  // namespace frontend
