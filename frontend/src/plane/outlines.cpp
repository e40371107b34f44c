#include "plane/outlines.hpp"

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace frontend {
namespace {

using ClipperLib::cInt;
using csgcore::FillRule;
using csgcore::Op;

/// The library computes with 64 bits up to 2^30, and slower, with 128, up to 2^62.
constexpr int kClipperBits = 29;
constexpr int kMostGridBits = 60;
/// The grid is at least as fine as 2^-20, whatever the size, as long as the library has the bits:
/// designs subtract small parts from very large squares.
constexpr int kLeastExponent = 20;

int grid_exponent(double reach) {
  if (!(reach > 0)) return 0;
  const int reach_exponent = std::ilogb(reach) + 1;
  return std::min(std::max(kClipperBits - reach_exponent, kLeastExponent),
                  kMostGridBits - reach_exponent);
}

/// The grid of whole numbers that holds all operands of a computation.
class Grid {
 public:
  /// `reach` is the largest coordinate.
  explicit Grid(double reach) : exponent_(grid_exponent(reach)) {}

  ClipperLib::Paths paths(std::span<const Polygon> polygons) {
    ClipperLib::Paths result;
    for (const Polygon& polygon : polygons) {
      ClipperLib::Path& path = result.emplace_back();
      for (const Vec2& point : polygon) {
        path.emplace_back(line(point.x, x_of_), line(point.y, y_of_));
      }
    }
    return result;
  }

  Polygons polygons(const ClipperLib::Paths& paths) const {
    Polygons result;
    for (const ClipperLib::Path& path : paths) {
      if (path.size() < 3) continue;
      Polygon& polygon = result.emplace_back();
      for (const ClipperLib::IntPoint& point : path) {
        polygon.emplace_back(coordinate(point.X, x_of_), coordinate(point.Y, y_of_));
      }
    }
    return result;
  }

  double scaled(double length) const { return std::ldexp(length, exponent_); }

 private:
  using Lines = std::unordered_map<cInt, double>;

  cInt line(double coordinate, Lines& lines) const {
    const auto result = static_cast<cInt>(std::llround(std::ldexp(coordinate, exponent_)));
    lines.try_emplace(result, coordinate);
    return result;
  }
  double coordinate(cInt line, const Lines& lines) const {
    const auto found = lines.find(line);
    return found != lines.end() ? found->second : std::ldexp(static_cast<double>(line), -exponent_);
  }

  int exponent_;
  Lines x_of_, y_of_;
};

double reach_of(const Rectangle& box) {
  if (box.empty()) return 0;
  return std::max(
      {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
}

struct Segment {
  Vec2 min, max;  // of its box
  Vec2 from, to;
};

/// Returns whether segments whose boxes overlap cross, or touch.
bool cross_or_touch(const Segment& a, const Segment& b) {
  const auto divides = [](const Segment& line, const Segment& other) {
    const Vec2 along = line.to - line.from;
    return cross(along, other.from - line.from) * cross(along, other.to - line.from) <= 0;
  };
  return divides(a, b) && divides(b, a);
}

/// Whether pairs of segments count that cross or touch, or, of lines with a width, those whose
/// boxes overlap.
enum class Overlap : uint8_t { kSegments, kBoxes };

/// Returns whether more than `most` pairs of segments overlap, or whether that takes too long to
/// tell.
bool overlap_more_than(std::vector<Segment> segments, uint64_t most,
                       Overlap overlap = Overlap::kSegments) {
  constexpr uint64_t kMostComparisons = 1 << 30;  // about a second
  constexpr uint64_t kStepsOfCrossing = 8;        // to tell whether segments cross takes as long
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.min.x < b.min.x; });
  uint64_t count = 0;
  uint64_t steps = 0;
  std::vector<const Segment*> open;
  for (const Segment& segment : segments) {
    std::erase_if(open, [&](const Segment* other) { return other->max.x < segment.min.x; });
    for (const Segment* other : open) {
      if (other->min.y > segment.max.y || segment.min.y > other->max.y) continue;
      steps += kStepsOfCrossing;
      count += overlap == Overlap::kBoxes || cross_or_touch(*other, segment);
    }
    steps += open.size();
    if (count > most || steps > kMostComparisons) return true;
    open.push_back(&segment);
  }
  return false;
}

void add_segments(std::span<const Polygon> polygons, std::vector<Segment>& segments) {
  for (const Polygon& polygon : polygons) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      Rectangle box;
      box.merge(polygon[i]);
      box.merge(polygon[(i + 1) % polygon.size()]);
      segments.push_back({box.min, box.max, polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }
}

ClipperLib::PolyFillType fill_type(FillRule rule) {
  return rule == FillRule::kEvenOdd ? ClipperLib::pftEvenOdd : ClipperLib::pftNonZero;
}

ClipperLib::ClipType clip_type(Op op) {
  switch (op) {
    case Op::kUnion:
      return ClipperLib::ctUnion;
    case Op::kIntersection:
      return ClipperLib::ctIntersection;
    case Op::kDifference:
      return ClipperLib::ctDifference;
  }
  return ClipperLib::ctUnion;
}

ClipperLib::Paths united(const ClipperLib::Paths& paths, ClipperLib::PolyFillType fill) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(paths, ClipperLib::ptSubject, true);
  ClipperLib::Paths result;
  clipper.Execute(ClipperLib::ctUnion, result, fill, fill);
  return result;
}

ClipperLib::Paths combined(Op op, const ClipperLib::Paths& first, const ClipperLib::Paths& others) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(first, ClipperLib::ptSubject, true);
  clipper.AddPaths(others, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  clipper.Execute(clip_type(op), result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return result;
}

ClipperLib::JoinType join_type(CornerStyle corners) {
  switch (corners) {
    case CornerStyle::kRound:
      return ClipperLib::jtRound;
    case CornerStyle::kSharp:
      return ClipperLib::jtMiter;
    case CornerStyle::kSquare:
      return ClipperLib::jtSquare;
  }
  return ClipperLib::jtRound;
}

ClipperLib::EndType end_type(LineEnds ends) {
  switch (ends) {
    case LineEnds::kButt:
      return ClipperLib::etOpenButt;
    case LineEnds::kSquare:
      return ClipperLib::etOpenSquare;
    case LineEnds::kRound:
      return ClipperLib::etOpenRound;
  }
  return ClipperLib::etOpenSquare;
}

/// Returns whether an edge from one corner of a polygon to a later one may take the place of those
/// between them.
class Shortcuts {
 public:
  Shortcuts(const Polygon& polygon, double tolerance) : polygon_(polygon), tolerance_(tolerance) {
    visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
      edges_.push_back(b - a);
      lengths_.push_back(glm::length(b - a));
    });
  }

  /// Returns the last corner, from `first` + 2 on, that an edge may lead to; else the next one. The
  /// corner after the last is the first.
  size_t end(size_t first) const {
    constexpr size_t kMostEdges = 64;  // since each is asked for all corners before it
    const size_t most = std::min(polygon_.size(), first + kMostEdges);
    size_t last = first + 1;
    while (last < most && spans(first, last + 1)) ++last;
    return last;
  }

 private:
  bool spans(size_t first, size_t end) const {
    // An arc's edges differ from its chord by up to half of what they turn by: a 24th of a turn,
    // and somewhat less where edges are not small.
    constexpr double kLeastCosine = 0.99255;  // of 7°
    const Vec2 from = polygon_[first];
    const Vec2 way = polygon_[end % polygon_.size()] - from;
    const double length = glm::length(way);
    for (const size_t edge : {first, end - 1}) {
      if (!(glm::dot(edges_[edge], way) >= kLeastCosine * lengths_[edge] * length)) return false;
    }
    double along = 0;
    for (size_t i = first + 1; i < end; ++i) {
      const Vec2 to = polygon_[i] - from;
      const double next = glm::dot(to, way);
      const bool is_near = std::abs(way.x * to.y - way.y * to.x) <= tolerance_ * length;
      if (!is_near || !(next > along)) return false;
      along = next;
    }
    return true;
  }

  const Polygon& polygon_;
  const double tolerance_;
  std::vector<Vec2> edges_;
  std::vector<double> lengths_;
};

}  // namespace

std::optional<SimplePolygons> united(std::span<const Figure> figures, const Chords& chords) {
  std::vector<Polygons> parts;
  std::vector<Segment> segments;
  Rectangle box;
  for (const Figure& figure : figures) {
    const Polygons& part = parts.emplace_back(chords_of(figure, chords));
    add_segments(part, segments);
    box.merge(bounds_of(part));
  }
  if (overlap_more_than(std::move(segments), kMostCrossings)) return std::nullopt;
  Grid grid(reach_of(box));
  ClipperLib::Paths all;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Outline* outline = std::get_if<Outline>(&figures[i]);
    ClipperLib::Paths paths = grid.paths(parts[i]);
    if (outline != nullptr) paths = united(paths, fill_type(outline->fill_rule));
    all.insert(all.end(), paths.begin(), paths.end());
  }
  if (figures.size() > 1) all = united(all, ClipperLib::pftNonZero);
  return grid.polygons(all);
}

std::optional<SimplePolygons> combined(Op op, std::span<const SimplePolygons> operands) {
  if (operands.empty()) return SimplePolygons{};
  std::vector<Segment> segments;
  Rectangle box;
  for (const SimplePolygons& operand : operands) {
    add_segments(operand, segments);
    box.merge(bounds_of(operand));
  }
  if (overlap_more_than(std::move(segments), kMostCrossings)) return std::nullopt;
  Grid grid(reach_of(box));
  ClipperLib::Paths result = grid.paths(operands.front());
  if (op == Op::kIntersection) {
    for (const SimplePolygons& operand : operands.subspan(1)) {
      result = combined(op, result, grid.paths(operand));
    }
  } else {
    ClipperLib::Paths others;
    for (const SimplePolygons& operand : operands.subspan(1)) {
      const ClipperLib::Paths paths = grid.paths(operand);
      others.insert(others.end(), paths.begin(), paths.end());
    }
    result = combined(op, result, others);
  }
  return grid.polygons(result);
}

SimplePolygons moved_outline(const SimplePolygons& polygons, double distance, CornerStyle corners,
                             int fragments) {
  Grid grid(reach_of(bounds_of(polygons)) + std::abs(distance));
  // OpenSCAD never cuts a sharp corner off: its limit is as large.
  constexpr double kMiterLimit = 1e6;
  const double scaled = grid.scaled(distance);
  const double tolerance = std::abs(scaled) * (1 - std::cos(std::numbers::pi / fragments));
  ClipperLib::ClipperOffset offset(kMiterLimit, tolerance);
  offset.AddPaths(grid.paths(polygons), join_type(corners), ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  offset.Execute(result, scaled);
  return grid.polygons(result);
}

bool crosses_itself(const Polygon& path, double width, uint64_t most) {
  std::vector<Segment> segments;
  add_segments({&path, 1}, segments);
  segments.pop_back();  // the path does not run back to its start
  for (Segment& segment : segments) {
    segment.min -= width / 2;
    segment.max += width / 2;
  }
  return overlap_more_than(std::move(segments), most, Overlap::kBoxes);
}

std::optional<SimplePolygons> stroked(const Polygon& path, const StrokeSettings& settings) {
  // Both sides of a line cross both of another one.
  constexpr uint64_t kCrossingsOfLines = 4;
  if (crosses_itself(path, settings.width, kMostCrossings / kCrossingsOfLines)) return std::nullopt;
  const double reach = reach_of(bounds_of(std::span(&path, 1))) + settings.width;
  // OpenSCAD's whole numbers, as far as the library has them.
  constexpr double kCoarseUnit = 1e-4;
  const bool is_coarse =
      settings.chords == StrokeChords::kOf2021 && reach < std::ldexp(kCoarseUnit, kMostGridBits);
  const double unit = is_coarse ? kCoarseUnit : 1;
  Polygon scaled;
  for (const Vec2& point : path) scaled.push_back(point / unit);
  Grid grid(is_coarse ? 0 : reach);
  const double half_width = grid.scaled(settings.width / unit / 2);
  constexpr double kMiterLimit = 2;  // the library's own, and OpenSCAD's, too
  constexpr double kCoarseTolerance = 0.25;
  // A share of the distance, as the newer library of OpenSCAD 2026 has it.
  constexpr double kTolerance2026 = 0.002;
  const double share = settings.chords == StrokeChords::kOf2026
                           ? kTolerance2026
                           : 1 - std::cos(std::numbers::pi / kChordsOfCircle);
  ClipperLib::ClipperOffset offset(kMiterLimit, is_coarse ? kCoarseTolerance : half_width * share);
  offset.AddPaths(grid.paths(std::span(&scaled, 1)), join_type(settings.corners),
                  end_type(settings.ends));
  ClipperLib::Paths result;
  offset.Execute(result, half_width);
  SimplePolygons polygons = grid.polygons(result);
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) point *= unit;
  }
  return polygons;
}

std::optional<Figure> cleaned(Outline outline) {
  std::optional<Polygon> convex = convex_corners(outline);
  if (convex) return outline_of(Polygons{std::move(*convex)});
  const Figure figure = std::move(outline);
  std::optional<SimplePolygons> polygons = united({&figure, 1});
  if (!polygons) return figure;
  if (polygons->empty()) return std::nullopt;
  return outline_of(std::move(*polygons));
}

SimplePolygons without_slight_corners(SimplePolygons polygons, double rounding) {
  Grid grid(reach_of(bounds_of(polygons)));
  for (Polygon& polygon : polygons) {
    ClipperLib::Paths path = grid.paths(std::span(&polygon, 1));
    ClipperLib::CleanPolygons(path, grid.scaled(rounding));
    if (path.front().size() >= 3) polygon = std::move(grid.polygons(path).front());
  }
  return polygons;
}

SimplePolygons with_fewer_corners(SimplePolygons polygons, double tolerance) {
  SimplePolygons result;
  for (const Polygon& polygon : polygons) {
    const Shortcuts shortcuts(polygon, tolerance);
    Polygon fewer;
    for (size_t i = 0; i < polygon.size(); i = shortcuts.end(i)) fewer.push_back(polygon[i]);
    result.push_back(fewer.size() < 3 ? polygon : std::move(fewer));
  }
  if (edge_count(result) == edge_count(polygons)) return polygons;
  Grid grid(reach_of(bounds_of(result)));
  const ClipperLib::Paths paths = grid.paths(result);
  const ClipperLib::Paths simple = united(paths, ClipperLib::pftNonZero);
  const auto area = [](const ClipperLib::Paths& all) {
    double sum = 0;
    for (const ClipperLib::Path& path : all) sum += ClipperLib::Area(path);
    return sum;
  };
  // What crosses runs around some of its area backwards.
  constexpr double kRounding = 1e-9;
  const bool is_simple =
      simple.size() == paths.size() && area(simple) - area(paths) <= kRounding * area(simple);
  return is_simple ? result : polygons;
}

std::optional<std::vector<Figure>> without_holes(std::span<const Figure> figures) {
  std::optional<SimplePolygons> polygons = united(figures);
  if (!polygons) return std::nullopt;
  std::erase_if(*polygons, [](const Polygon& polygon) { return signed_area(polygon) <= 0; });
  std::vector<Figure> result;
  if (!std::all_of(figures.begin(), figures.end(), is_polygonal)) {
    result.assign(figures.begin(), figures.end());
  }
  result.push_back(outline_of(std::move(*polygons), FillRule::kNonZero));
  return result;
}

}  // namespace frontend
