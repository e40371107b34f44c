#include "plane/offset.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "plane/hull.hpp"

namespace frontend {
namespace {

using csgcore::FillRule;
using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

/// The unit normal on the right of the way from a to b: outwards of what runs counterclockwise.
Vec2 outward_normal(const Vec2& a, const Vec2& b) {
  const Vec2 along = glm::normalize(b - a);
  return {along.y, -along.x};
}

ProfileEdge straight_to(const Vec2& end) {
  ProfileEdge edge;
  edge.end = end;
  return edge;
}

/// A convex corner with the normals of the edges before and after it.
struct Corner {
  Vec2 at, n_before, n_after;
  size_t index;

  /// From 0 to π, where a line turns back.
  double turn() const {
    return std::atan2(std::abs(cross(n_before, n_after)), glm::dot(n_before, n_after));
  }
};

/// Adds the way around the corner at that distance, from the first normal to the second.
void add_arc(const Corner& corner, double distance, ProfileLoop& loop) {
  ProfileEdge arc;
  arc.kind = ProfileEdge::Kind::kArc;
  arc.control = corner.at;
  arc.end = corner.at + distance * corner.n_after;
  loop.push_back(arc);
}

/// Adds chords around the corner: each turns by a whole fragment, but for the last one. Inwards the
/// way is that of the outline's other side, whose first chord is the last one here.
void add_chords(const Corner& corner, const OffsetSettings& settings, ProfileLoop& loop) {
  constexpr double kRounding = 0x1p-30;  // no chord is as short a share of the others
  const double fragment = 2 * std::numbers::pi / *settings.fragments;
  const int count = static_cast<int>(std::ceil(corner.turn() / fragment - kRounding));
  const double distance = std::abs(settings.distance);
  for (int i = 1; i < count; ++i) {
    const bool is_outwards = settings.distance > 0;
    const double turn = is_outwards ? i * fragment : (i - count) * fragment;
    const Vec2& from = is_outwards ? corner.n_before : corner.n_after;
    const Vec2 normal = std::cos(turn) * from + std::sin(turn) * Vec2(-from.y, from.x);
    loop.push_back(line_to(corner.at + distance * normal));
  }
  loop.push_back(line_to(corner.at + distance * corner.n_after));
}

/// Cuts the corner square at that distance.
void add_square(const Corner& corner, double distance, ProfileLoop& loop) {
  const double t = std::tan(corner.turn() / 4);
  const Vec2 &a = corner.n_before, &b = corner.n_after;
  loop.push_back(line_to(corner.at + distance * (a + t * Vec2(-a.y, a.x))));
  loop.push_back(line_to(corner.at + distance * (b + t * Vec2(b.y, -b.x))));
  loop.push_back(line_to(corner.at + distance * b));
}

/// Lets the edges run on until they meet, unless that is too far away, as SVG does by default.
void add_sharp(const Corner& corner, double distance, ProfileLoop& loop) {
  constexpr double kMiterLimit = 2;  // Clipper's own, and OpenSCAD's: a share of the distance
  const double share = 1 + glm::dot(corner.n_before, corner.n_after);
  if (share < 2 / (kMiterLimit * kMiterLimit)) return add_square(corner, distance, loop);
  loop.push_back(line_to(corner.at + distance / share * (corner.n_before + corner.n_after)));
  loop.push_back(line_to(corner.at + distance * corner.n_after));
}

/// The boundary of the polygon, of a rectangle upon each edge and of what add_corner(corner, loop)
/// makes of each convex corner, all of which run counterclockwise, added up. What cancels is left
/// out. So the winding number is nowhere negative, and is not 0 on the union: the offset.
template <typename AddCorner>
ProfileLoop outset(const Polygon& polygon, double distance, const AddCorner& add_corner) {
  ProfileLoop loop;
  const size_t count = polygon.size();
  for (size_t i = 0; i < count; ++i) {
    const Vec2& before = polygon[(i + count - 1) % count];
    const Vec2& at = polygon[i];
    const Vec2& after = polygon[(i + 1) % count];
    const Vec2 n_before = outward_normal(before, at);
    const Vec2 n_after = outward_normal(at, after);
    const double turn = cross(n_before, n_after);
    loop.push_back(straight_to(at + distance * n_before));
    if (turn > 0 || (turn == 0 && glm::dot(n_before, n_after) < 0)) {
      add_corner(Corner{at, n_before, n_after, i}, loop);
    } else if (turn < 0) {
      loop.push_back(straight_to(at));
      loop.push_back(straight_to(at + distance * n_after));
    }
  }
  return loop;
}

/// The offset outwards with round corners.
std::optional<Figure> rounded(const Figure& figure, double distance) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    return Disc{disc->center, disc->radius + distance};
  }
  std::optional<SimplePolygons> polygons;
  if (std::optional<Polygon> convex = convex_corners(figure)) {
    polygons = SimplePolygons{std::move(*convex)};
  } else {
    polygons = united({&figure, 1});
  }
  if (!polygons) return std::nullopt;
  Outline outline;
  outline.fill_rule = FillRule::kNonZero;
  for (const Polygon& polygon : *polygons) {
    outline.loops.push_back(outset(polygon, distance, [&](const Corner& corner, ProfileLoop& loop) {
      add_arc(corner, distance, loop);
    }));
  }
  return outline;
}

/// The offset with chords for round corners. Inwards it is what the outside, offset, leaves.
std::optional<SimplePolygons> chorded(SimplePolygons polygons, const OffsetSettings& settings) {
  Rectangle box = bounds_of(polygons);
  const double distance = std::abs(settings.distance);
  const bool is_inwards = settings.distance < 0;
  if (box.empty()) return polygons;
  box.min -= 2 * distance;
  box.max += 2 * distance;
  const Polygon around = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
  if (is_inwards) {
    for (Polygon& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
    polygons.push_back(around);
  }
  Outline outline;
  outline.fill_rule = FillRule::kNonZero;
  for (const Polygon& polygon : polygons) {
    outline.loops.push_back(outset(polygon, distance, [&](const Corner& corner, ProfileLoop& loop) {
      add_chords(corner, settings, loop);
    }));
  }
  const Figure figure = std::move(outline);
  const std::optional<SimplePolygons> offset = united({&figure, 1});
  if (!offset || !is_inwards) return offset;
  return combined(csgcore::Op::kDifference, std::vector<SimplePolygons>{{around}, *offset});
}

/// Returns how many whole turns the round corners of the offset inwards make together.
double turns_inwards(const SimplePolygons& polygons) {
  double turns = 0;
  for (const Polygon& polygon : polygons) {
    const size_t count = polygon.size();
    for (size_t i = 0; i < count; ++i) {
      const Vec2 in = polygon[i] - polygon[(i + count - 1) % count];
      const Vec2 out = polygon[(i + 1) % count] - polygon[i];
      turns += std::max(0.0, std::atan2(-cross(in, out), glm::dot(in, out)));
    }
  }
  return turns / (2 * std::numbers::pi);
}

/// Returns the numbers of chords to try, the first of which that does not cross too often counts.
/// None: the library's offset is as good.
std::vector<int> chords_to_try(const SimplePolygons& polygons, const OffsetSettings& settings) {
  if (settings.corners != CornerStyle::kRound) return {};
  if (settings.fragments)
    return settings.has_chord_for_rest ? std::vector{*settings.fragments} : std::vector<int>{};
  // The library takes seconds for more that cross each other, as those between spikes do.
  constexpr double kManyChords = 1 << 17;
  if (turns_inwards(polygons) * kChordsOfCircle <= kManyChords) return {};
  return {kChordsOfCircle, 24, 6};
}

Polygon moved(Polygon polygon, const Vec2& by) {
  for (Vec2& point : polygon) point += by;
  return polygon;
}

SimplePolygons moved(SimplePolygons polygons, const Vec2& by) {
  for (Polygon& polygon : polygons) polygon = moved(std::move(polygon), by);
  return polygons;
}

/// From the lowest corner on, the leftmost of several.
Polygon from_lowest(Polygon polygon) {
  const auto lowest = std::min_element(
      polygon.begin(), polygon.end(),
      [](const Vec2& a, const Vec2& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  std::rotate(polygon.begin(), lowest, polygon.end());
  return polygon;
}

/// The edges of both, in the order of their directions.
Polygon sum_of_convex(const Polygon& first, const Polygon& second) {
  const Polygon a = from_lowest(first);
  const Polygon b = from_lowest(second);
  Polygon sum;
  for (size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const Vec2& at_a = a[i % a.size()];
    const Vec2& at_b = b[j % b.size()];
    sum.push_back(at_a + at_b);
    const double turn = cross(a[(i + 1) % a.size()] - at_a, b[(j + 1) % b.size()] - at_b);
    const bool takes_a = j == b.size() || (i < a.size() && turn >= 0);
    const bool takes_b = i == a.size() || (j < b.size() && turn <= 0);
    i += takes_a;
    j += takes_b;
  }
  return sum;
}

/// More corners of parts than this would have too many crossings anyway.
constexpr size_t kMostPairs = 1 << 18;

Figure filled(SimplePolygons polygons) {
  return outline_of(std::move(polygons), FillRule::kNonZero);
}

/// Each of them moved to a point of every loop of the other, and the parallelograms that the edges
/// of both span: a point of the sum that none of the former holds is where one boundary passes the
/// other.
std::optional<Figure> sum_of_polygons(const SimplePolygons& a, const SimplePolygons& b) {
  if (edge_count(a) * edge_count(b) > kMostPairs) return std::nullopt;
  std::vector<Figure> parts;
  for (const Polygon& loop : b) parts.push_back(filled(moved(a, loop.front())));
  for (const Polygon& loop : a) parts.push_back(filled(moved(b, loop.front())));
  visit_edges(a, [&](const Vec2& a_start, const Vec2& a_end) {
    visit_edges(b, [&](const Vec2& b_start, const Vec2& b_end) {
      parts.push_back(
          filled({{a_start + b_start, a_end + b_start, a_end + b_end, a_start + b_end}}));
    });
  });
  std::optional<SimplePolygons> sum = united(parts);
  if (!sum) return std::nullopt;
  return filled(std::move(*sum));
}

/// The polygons moved to a corner of the convex one, and what the convex one covers along each
/// edge.
std::optional<Figure> sum_with_convex(const SimplePolygons& polygons, const Polygon& convex) {
  if (edge_count(polygons) * convex.size() > kMostPairs) return std::nullopt;
  std::vector<Figure> parts{filled(moved(polygons, convex.front()))};
  visit_edges(polygons, [&](const Vec2& start, const Vec2& end) {
    std::vector<Disc> points;
    for (const Vec2& corner : convex) {
      points.push_back({start + corner, 0});
      points.push_back({end + corner, 0});
    }
    parts.push_back(convex_hull(points));
  });
  std::optional<SimplePolygons> sum = united(parts);
  if (!sum) return std::nullopt;
  return filled(std::move(*sum));
}

std::optional<Figure> sum_of_two(const Figure& a, const Figure& b) {
  if (const Disc* disc = std::get_if<Disc>(&b)) {
    const std::optional<Figure> sum = rounded(a, disc->radius);
    if (!sum) return std::nullopt;
    return mapped(PlaneMap{glm::dmat2(1.0), disc->center}, *sum);
  }
  if (std::holds_alternative<Disc>(a)) return sum_of_two(b, a);
  const std::optional<Polygon> convex_a = convex_corners(a);
  const std::optional<Polygon> convex_b = convex_corners(b);
  if (convex_a && convex_b) return outline_of(Polygons{sum_of_convex(*convex_a, *convex_b)});
  if (convex_a) return sum_of_two(b, a);
  const std::optional<SimplePolygons> polygons_a = united({&a, 1});
  const std::optional<SimplePolygons> polygons_b = united({&b, 1});
  if (!polygons_a || !polygons_b) return std::nullopt;
  return convex_b ? sum_with_convex(*polygons_a, *convex_b)
                  : sum_of_polygons(*polygons_a, *polygons_b);
}

}  // namespace

std::optional<std::vector<Figure>> offset(std::span<const Figure> figures,
                                          const OffsetSettings& settings) {
  std::vector<Figure> result;
  const bool is_round = settings.corners == CornerStyle::kRound;
  if (is_round && settings.distance > 0 && !settings.fragments) {
    // The offset of a union is the union of the offsets.
    for (const Figure& figure : figures) {
      std::optional<Figure> part = rounded(figure, settings.distance);
      if (!part) return std::nullopt;
      result.push_back(std::move(*part));
    }
    return result;
  }
  const std::optional<SimplePolygons> polygons = united(figures);
  if (!polygons) return std::nullopt;
  const std::vector<int> choices = chords_to_try(*polygons, settings);
  for (const int chords : choices) {
    OffsetSettings tried = settings;
    tried.fragments = chords;
    if (std::optional<SimplePolygons> outcome = chorded(*polygons, tried)) {
      result.push_back(filled(std::move(*outcome)));
      return result;
    }
  }
  if (!choices.empty()) return std::nullopt;
  result.push_back(filled(moved_outline(*polygons, settings.distance, settings.corners,
                                        settings.fragments.value_or(kChordsOfCircle))));
  return result;
}

Figure pen_trace(Polygon path, const StrokeSettings& settings) {
  const double distance = settings.width / 2;
  path.erase(std::unique(path.begin(), path.end()), path.end());
  Outline outline;
  outline.fill_rule = FillRule::kNonZero;
  if (path.size() == 1 && settings.corners == CornerStyle::kRound) {
    return Disc{path.front(), distance};
  }
  if (path.size() == 1) {
    const Vec2 &at = path.front(), up(-distance, distance);
    return outline_of(Polygons{{at - distance, at - up, at + distance, at + up}});
  }
  // There and back: a polygon without an area, whose corners at the ends turn by 180°.
  const size_t last = path.size() - 1;
  for (size_t i = last; i-- > 1;) path.push_back(path[i]);
  const auto add_end = [&](const Corner& end, ProfileLoop& loop) {
    if (settings.ends == LineEnds::kRound) return add_arc(end, distance, loop);
    if (settings.ends == LineEnds::kSquare) return add_square(end, distance, loop);
    loop.push_back(line_to(end.at + distance * end.n_after));
  };
  outline.loops.push_back(outset(path, distance, [&](const Corner& corner, ProfileLoop& loop) {
    if (corner.index == 0 || corner.index == last) return add_end(corner, loop);
    switch (settings.corners) {
      case CornerStyle::kRound:
        return add_arc(corner, distance, loop);
      case CornerStyle::kSquare:
        return add_square(corner, distance, loop);
      case CornerStyle::kSharp:
        return add_sharp(corner, distance, loop);
    }
  }));
  return outline;
}

std::optional<std::vector<Figure>> minkowski_sum(std::span<const Figure> a,
                                                 std::span<const Figure> b) {
  std::vector<Figure> result;
  for (const Figure& one : a) {
    for (const Figure& other : b) {
      std::optional<Figure> sum = sum_of_two(one, other);
      if (!sum) return std::nullopt;
      result.push_back(std::move(*sum));
    }
  }
  return result;
}

}  // namespace frontend
