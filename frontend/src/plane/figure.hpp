// Plane figures, as OpenSCAD's 2D nodes make them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "csgcore/profile.hpp"
#include "plane/plane_map.hpp"

namespace frontend {

/// The corners of a polygon; the last one is joined to the first.
using Polygon = std::vector<Vec2>;
using Polygons = std::vector<Polygon>;

struct Disc {
  Vec2 center{0.0};
  double radius = 0;  // ≥ 0; a disc of radius 0 is a point
};

/// What its loops enclose.
struct Outline {
  std::vector<csgcore::ProfileLoop> loops;
  csgcore::FillRule fill_rule = csgcore::FillRule::kEvenOdd;
};

using Figure = std::variant<Disc, Outline>;

/// A closed rectangle whose sides are parallel to the axes; empty by default.
struct Rectangle {
  Vec2 min{std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
  void merge(const Vec2& point);
  void merge(const Rectangle& other);
};

/// The chords that stand for a whole circle where a curve has to become a polygon. The circle is at
/// most 4e-5 of its radius away from them, which is less than a pixel up to radii of 25,000 pixels.
constexpr int kChordsOfCircle = 360;

/// How curves become chords.
struct Chords {
  int most = kChordsOfCircle;  // for a whole circle
  /// A circle has fewer chords, but no fewer than `fewest`, if they are no farther from it.
  double tolerance = 0;
  int fewest = 24;
};

/// Returns OpenSCAD's polygon for a circle: its corners lie on the circle, the first one on +x.
Polygon circle_polygon(const Disc& disc, int fragments);

Outline outline_of(Polygons polygons, csgcore::FillRule fill_rule = csgcore::FillRule::kEvenOdd);
/// Returns the disc bounded by two arcs.
Outline outline_of(const Disc& disc);
/// Returns the figure, of either kind, by its loops.
Outline outline_of(const Figure& figure);

/// Returns the loops as polygons, with chords in place of curves.
Polygons chords_of(const Figure& figure, const Chords& chords = {});
/// Returns whether the figure has no curves.
bool is_polygonal(const Figure& figure);

/// Returns the image of the figure. What is round becomes chords where the image is no circle.
Figure mapped(const PlaneMap& map, const Figure& figure);

Rectangle bounds_of(const Figure& figure);
/// Returns the bounds of the figure's image.
Rectangle bounds_of(const PlaneMap& map, const Figure& figure);
Rectangle bounds_of(std::span<const Polygon> polygons);

size_t edge_count(std::span<const Polygon> polygons);

/// Returns what the cross product has in z: positive if `b` lies counterclockwise of `a`.
inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the straight edge to a point.
inline csgcore::ProfileEdge line_to(const Vec2& end) {
  csgcore::ProfileEdge edge;
  edge.end = end;
  return edge;
}

/// Calls visit(start, end) for each edge.
template <typename Visit>
void visit_edges(const Polygon& polygon, const Visit& visit) {
  for (size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}
template <typename Visit>
void visit_edges(const Polygons& polygons, const Visit& visit) {
  for (const Polygon& polygon : polygons) visit_edges(polygon, visit);
}

/// Returns the area of a polygon that does not cross itself, negative if it runs clockwise.
double signed_area(const Polygon& polygon);

/// Returns the corners of a convex polygon counterclockwise, without those that are no corners;
/// nothing if the figure is none.
std::optional<Polygon> convex_corners(const Figure& figure);

/// Returns the part of the figure with x ≥ 0.
Outline right_half(const Figure& figure);

}  // namespace frontend
