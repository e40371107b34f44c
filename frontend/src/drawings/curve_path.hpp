// Paths of lines and curves, as drawings have them.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/profile.hpp"
#include "plane/figure.hpp"
#include "plane/plane_map.hpp"

namespace frontend {

/// A part of an ellipse: center + cos(t)·u + sin(t)·v, with t from `start` by `sweep`, in radians.
struct EllipseArc {
  Vec2 center{0.0};
  Vec2 u{0.0};
  Vec2 v{0.0};
  double start = 0;
  double sweep = 0;

  Vec2 point(double t) const { return center + std::cos(t) * u + std::sin(t) * v; }
  Vec2 first() const { return point(start); }
  Vec2 last() const { return point(start + sweep); }
};

EllipseArc mapped(const PlaneMap& map, const EllipseArc& arc);
/// Returns the arc in the other direction.
EllipseArc reversed(const EllipseArc& arc);

/// OpenSCAD draws nothing that has a larger coordinate: in units of 2^-16 it would not fit into 62
/// bits.
constexpr double kFarthest = 0x1p46;

/// How finely curves that a profile cannot hold (ellipses, cubics) are cut into quadratics.
struct CurveFineness {
  double tolerance = 0;       // the largest distance from the curve
  int most_pieces = 1 << 10;  // of one curve
};

/// Returns a fineness that no picture shows, for a drawing in the box with so many curves. Very
/// many curves have few pieces each.
CurveFineness fineness_of(const Rectangle& box, size_t curves);

/// A path from a first point on, by lines and curves.
class CurvePath {
 public:
  explicit CurvePath(const Vec2& first) : first_(first), last_(first) {}

  void line_to(const Vec2& end);
  void quadratic_to(const Vec2& control, const Vec2& end);
  void cubic_to(const Vec2& control, const Vec2& second_control, const Vec2& end);
  /// The arc begins, up to rounding, where the path ends, and goes on to `end`, its last point.
  /// `pieces` are those that OpenSCAD cuts it into.
  void arc_to(const EllipseArc& arc, int pieces, const Vec2& end);

  const Vec2& first() const { return first_; }
  const Vec2& last() const { return last_; }
  /// Returns a box that holds the path: that of its control points.
  Rectangle bounds() const;
  /// Returns whether all of it is finite, and no farther than kFarthest.
  bool is_in_range() const;
  /// Returns how many curves it has.
  size_t curves() const { return curves_; }

  CurvePath mapped(const PlaneMap& map) const;
  /// Returns OpenSCAD's points on the path, the first one among them. A Bézier curve has so many
  /// chords, and no curve has more than the most.
  Polygon openscad_points(int bezier_chords, int most_chords) const;
  /// Returns the path, closed by a line where it is open.
  csgcore::ProfileLoop loop(const CurveFineness& fineness) const;

 private:
  enum class Kind : uint8_t { kLine, kQuadratic, kCubic, kArc };
  /// Calls visit(kind, start, its points).
  template <typename Visit>
  void visit_segments(const Visit& visit) const;

  Vec2 first_;
  Vec2 last_;
  size_t curves_ = 0;
  std::vector<Kind> kinds_;
  /// The control points and the end of each segment in turn. An arc has its centre, u, v, then
  /// start and sweep, then the number of OpenSCAD's pieces and 0, then its end.
  std::vector<Vec2> points_;
};

}  // namespace frontend
