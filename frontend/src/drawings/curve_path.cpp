#include "drawings/curve_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

namespace frontend {
namespace {

using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

constexpr double kQuarter = std::numbers::pi / 2;
/// The number of points that a segment has of each kind.
constexpr std::array<size_t, 4> kPointsOfKind{1, 2, 3, 6};

ProfileEdge line_edge(const Vec2& end) {
  ProfileEdge edge;
  edge.end = end;
  return edge;
}

ProfileEdge bezier_edge(const Vec2& control, const Vec2& end) {
  ProfileEdge edge;
  edge.kind = ProfileEdge::Kind::kBezier;
  edge.control = control;
  edge.end = end;
  return edge;
}

EllipseArc arc_of(std::span<const Vec2> points) {
  return {points[0], points[1], points[2], points[3].x, points[3].y};
}

Vec2 quadratic_point(const Vec2& a, const Vec2& b, const Vec2& c, double t) {
  return (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c;
}

/// A cubic Bézier curve as a polynomial of its parameter.
struct Cubic {
  Vec2 constant, linear, square, cube;

  Cubic(const Vec2& start, std::span<const Vec2> points)
      : constant(start),
        linear(3.0 * (points[0] - start)),
        square(3.0 * (points[1] - 2.0 * points[0] + start)),
        cube(points[2] - 3.0 * points[1] + 3.0 * points[0] - start) {}

  Vec2 point(double t) const { return constant + t * (linear + t * (square + t * cube)); }
  Vec2 derivative(double t) const { return linear + t * (2.0 * square + 3.0 * t * cube); }
};

int pieces_within(double count, const CurveFineness& fineness) {
  if (!(count > 1)) return 1;
  return static_cast<int>(std::min(std::ceil(count), static_cast<double>(fineness.most_pieces)));
}

/// Arcs of at most a quarter turn.
void add_circle_arc(const EllipseArc& arc, const Vec2& end, ProfileLoop& loop) {
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / kQuarter)));
  const double turn = cross(arc.u, arc.v);
  for (int i = 1; i <= count; ++i) {
    ProfileEdge edge;
    edge.kind = ProfileEdge::Kind::kArc;
    edge.control = arc.center;
    edge.is_counterclockwise = (arc.sweep > 0) == (turn > 0);
    edge.end = i == count ? end : arc.point(arc.start + arc.sweep * i / count);
    loop.push_back(edge);
  }
}

/// A quadratic over an angle θ of an ellipse that has its tangents at both ends is at most θ⁴/128
/// of the longer axis away from it.
void add_ellipse_arc(const EllipseArc& arc, const Vec2& end, const CurveFineness& fineness,
                     ProfileLoop& loop) {
  const double axis = glm::length(arc.u) + glm::length(arc.v);  // at least the longer one
  const double angle = std::min(kQuarter, std::pow(128 * fineness.tolerance / axis, 0.25));
  const int least = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / kQuarter)));
  const int count = std::max(least, pieces_within(std::abs(arc.sweep) / angle, fineness));
  const double half = arc.sweep / count / 2;
  for (int i = 1; i <= count; ++i) {
    const double t = arc.start + 2 * half * i;
    const Vec2 control = arc.center + (arc.point(t - half) - arc.center) / std::cos(half);
    loop.push_back(bezier_edge(control, i == count ? end : arc.point(t)));
  }
}

/// A quadratic with the derivatives of a cubic at its ends, on average, is at most √3/36 of the
/// cubic's last coefficient away from it; of n pieces each has 1/n³ of that.
void add_cubic(const Vec2& start, std::span<const Vec2> points, const CurveFineness& fineness,
               ProfileLoop& loop) {
  const Cubic cubic(start, points);
  const double distance = std::sqrt(3.0) / 36 * glm::length(cubic.cube);
  const int count = pieces_within(std::cbrt(distance / fineness.tolerance), fineness);
  Vec2 from = start;
  for (int i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    const Vec2 to = i == count ? points[2] : cubic.point(t);
    const Vec2 slope = cubic.derivative(t - 1.0 / count) - cubic.derivative(t);
    loop.push_back(bezier_edge((from + to) / 2.0 + slope / (4.0 * count), to));
    from = to;
  }
}

}  // namespace

EllipseArc mapped(const PlaneMap& map, const EllipseArc& arc) {
  return {map.point(arc.center), map.linear * arc.u, map.linear * arc.v, arc.start, arc.sweep};
}

EllipseArc reversed(const EllipseArc& arc) {
  return {arc.center, arc.u, arc.v, arc.start + arc.sweep, -arc.sweep};
}

CurveFineness fineness_of(const Rectangle& box, size_t curves) {
  constexpr double kShareOfSize = 0x1p-24;
  constexpr size_t kMostPieces = 1 << 22;  // of all curves; as edges of a profile they have 170 MB
  constexpr size_t kLeastPieces = 4;
  CurveFineness fineness;
  if (!box.empty()) {
    fineness.tolerance = kShareOfSize * std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  }
  const size_t share = kMostPieces / std::max<size_t>(curves, 1);
  fineness.most_pieces =
      std::min(fineness.most_pieces, static_cast<int>(std::max(kLeastPieces, share)));
  return fineness;
}

void CurvePath::line_to(const Vec2& end) {
  kinds_.push_back(Kind::kLine);
  points_.push_back(end);
  last_ = end;
}

void CurvePath::quadratic_to(const Vec2& control, const Vec2& end) {
  kinds_.push_back(Kind::kQuadratic);
  points_.insert(points_.end(), {control, end});
  last_ = end;
  ++curves_;
}

void CurvePath::cubic_to(const Vec2& control, const Vec2& second_control, const Vec2& end) {
  kinds_.push_back(Kind::kCubic);
  points_.insert(points_.end(), {control, second_control, end});
  last_ = end;
  ++curves_;
}

void CurvePath::arc_to(const EllipseArc& arc, int pieces, const Vec2& end) {
  kinds_.push_back(Kind::kArc);
  points_.insert(points_.end(),
                 {arc.center, arc.u, arc.v, Vec2(arc.start, arc.sweep), Vec2(pieces, 0), end});
  last_ = end;
  ++curves_;
}

template <typename Visit>
void CurvePath::visit_segments(const Visit& visit) const {
  Vec2 start = first_;
  const Vec2* at = points_.data();
  for (const Kind kind : kinds_) {
    const std::span<const Vec2> points(at, kPointsOfKind[static_cast<size_t>(kind)]);
    visit(kind, start, points);
    start = points.back();
    at += points.size();
  }
}

Rectangle CurvePath::bounds() const {
  Rectangle box;
  box.merge(first_);
  visit_segments([&](Kind kind, const Vec2&, std::span<const Vec2> points) {
    if (kind != Kind::kArc) {
      for (const Vec2& point : points) box.merge(point);
      return;
    }
    const EllipseArc arc = arc_of(points);
    const Vec2 reach(std::hypot(arc.u.x, arc.v.x), std::hypot(arc.u.y, arc.v.y));
    box.merge(arc.center - reach);
    box.merge(arc.center + reach);
  });
  return box;
}

bool CurvePath::is_in_range() const {
  const auto is_near = [](const Vec2& p) {
    return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest;
  };
  return is_near(first_) && std::all_of(points_.begin(), points_.end(), is_near);
}

CurvePath CurvePath::mapped(const PlaneMap& map) const {
  CurvePath result(map.point(first_));
  visit_segments([&](Kind kind, const Vec2&, std::span<const Vec2> points) {
    switch (kind) {
      case Kind::kLine:
        return result.line_to(map.point(points[0]));
      case Kind::kQuadratic:
        return result.quadratic_to(map.point(points[0]), map.point(points[1]));
      case Kind::kCubic:
        return result.cubic_to(map.point(points[0]), map.point(points[1]), map.point(points[2]));
      case Kind::kArc:
        return result.arc_to(frontend::mapped(map, arc_of(points)), static_cast<int>(points[4].x),
                             map.point(points[5]));
    }
  });
  return result;
}

Polygon CurvePath::openscad_points(int bezier_chords, int most_chords) const {
  Polygon result{first_};
  bezier_chords = std::min(bezier_chords, most_chords);
  visit_segments([&](Kind kind, const Vec2& start, std::span<const Vec2> points) {
    if (kind == Kind::kArc) {
      const EllipseArc arc = arc_of(points);
      const int count = std::min(static_cast<int>(points[4].x), most_chords);
      for (int i = 1; i < count; ++i) {
        result.push_back(arc.point(arc.start + arc.sweep * i / count));
      }
    } else if (kind != Kind::kLine) {
      for (int i = 1; i < bezier_chords; ++i) {
        const double t = static_cast<double>(i) / bezier_chords;
        result.push_back(kind == Kind::kCubic ? Cubic(start, points).point(t)
                                              : quadratic_point(start, points[0], points[1], t));
      }
    }
    result.push_back(points.back());
  });
  return result;
}

ProfileLoop CurvePath::loop(const CurveFineness& fineness) const {
  ProfileLoop result;
  visit_segments([&](Kind kind, const Vec2& start, std::span<const Vec2> points) {
    if (kind == Kind::kArc) {
      const EllipseArc arc = arc_of(points);
      const PlaneMap axes{glm::dmat2(arc.u.x, arc.u.y, arc.v.x, arc.v.y), arc.center};
      if (keeps_circles(axes)) {
        add_circle_arc(arc, points.back(), result);
      } else {
        add_ellipse_arc(arc, points.back(), fineness, result);
      }
    } else if (kind == Kind::kCubic) {
      add_cubic(start, points, fineness, result);
    } else if (kind == Kind::kQuadratic) {
      result.push_back(bezier_edge(points[0], points[1]));
    } else {
      result.push_back(line_edge(points[0]));
    }
  });
  if (last_ != first_) result.push_back(line_edge(first_));
  return result;
}

}  // namespace frontend
