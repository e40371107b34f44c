#include "arrangement/planar_subdivision.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace csgcore {
namespace {

glm::dvec2 drawn(const ArrangedPoint& point, int axis) {
  return {point.position[u_axis(axis)], point.position[v_axis(axis)]};
}

bool is_corner(const ArrangedPoint& point) { return point.name.kind() == PointName::kCorner; }

GridPoint on_grid(const ArrangedPoint& corner) {
  const auto& [x, y, z] = std::array{corner.position.x, corner.position.y, corner.position.z};
  return {static_cast<int64_t>(x), static_cast<int64_t>(y), static_cast<int64_t>(z)};
}

/// Returns the point that a name defines which is no corner's.
ExactPoint exact_point(const Facets& facets, const PointName& name) {
  const auto& [kind, a, b, c, d] = name.numbers;
  const auto& points = facets.points;
  if (name.kind() == PointName::kEdgeAndFacet) return meet(points[a], points[b], facets.plane(c));
  if (name.kind() == PointName::kThreeFacets) {
    return meet(facets.plane(a), facets.plane(b), facets.plane(c));
  }
  // One end of the second edge is not on the first one's line.
  GridPlane plane = plane_through(points[a], points[b], points[c]);
  if (plane.normal == std::array<Int128, 3>{})
    plane = plane_through(points[a], points[b], points[d]);
  return meet(points[a], points[b], plane_along(points[c], points[d], plane.axis()));
}

/// Returns whether the points' names are one. The corners around a drawing have none.
bool are_same(const ArrangedPoint& a, const ArrangedPoint& b) {
  return a.name == b.name && a.position == b.position;
}

/// Returns whether the names say that the points lie on one edge of facets.
bool are_on_one_edge(const std::array<const ArrangedPoint*, 3>& points) {
  const auto all_are_on = [&](uint32_t low, uint32_t high) {
    return std::ranges::all_of(points, [&](const ArrangedPoint* point) {
      const auto& [kind, a, b, c, d] = point->name.numbers;
      if (kind == PointName::kCorner) return a == low || a == high;
      return kind != PointName::kThreeFacets &&
             ((a == low && b == high) ||
              (kind == PointName::kEdgeAndEdge && c == low && d == high));
    });
  };
  return std::ranges::any_of(points, [&](const ArrangedPoint* point) {
    const auto& [kind, a, b, c, d] = point->name.numbers;
    if (kind == PointName::kCorner || kind == PointName::kThreeFacets) return false;
    return all_are_on(a, b) || (kind == PointName::kEdgeAndEdge && all_are_on(c, d));
  });
}

}  // namespace

ArrangedPoint grid_point(const PointName& name, const GridPoint& point) {
  ArrangedPoint result;
  result.name = name;
  result.position = to_vec3(point);
  return result;
}

ArrangedPoint arranged_point(const Facets& facets, const PointName& name) {
  if (name.kind() == PointName::kCorner) return grid_point(name, facets.points[name.numbers[1]]);
  ArrangedPoint result;
  result.name = name;
  result.position = rounded(exact_point(facets, name));
  return result;
}

ExactPoint exact_point(const Facets& facets, const ArrangedPoint& point) {
  return is_corner(point) ? exact_point(on_grid(point)) : exact_point(facets, point.name);
}

int turn(const Facets& facets, const ArrangedPoint& a, const ArrangedPoint& b,
         const ArrangedPoint& c, int axis) {
  const glm::dvec2 p = drawn(b, axis) - drawn(a, axis);
  const glm::dvec2 q = drawn(c, axis) - drawn(a, axis);
  const double left = p.x * q.y;
  const double right = p.y * q.x;
  const double area = left - right;
  // The coordinates of p and q are off by 2·kPointError, and by half an ulp; so are the products
  // and their difference.
  const double off = 2 * kPointError;
  const double bound =
      off * (std::abs(p.x) + std::abs(p.y) + std::abs(q.x) + std::abs(q.y) + 2 * off) +
      4 * 0x1p-53 * (std::abs(left) + std::abs(right));
  if (std::abs(area) > bound) return sign_of(area);
  if (is_corner(a) && is_corner(b) && is_corner(c)) {
    return turn(on_grid(a), on_grid(b), on_grid(c), axis);
  }
  if (are_same(a, b) || are_same(b, c) || are_same(c, a) || are_on_one_edge({&a, &b, &c})) return 0;
  return turn(exact_point(facets, a), exact_point(facets, b), exact_point(facets, c), axis);
}

void PlanarSubdivision::start(const ArrangedPoint& a, const ArrangedPoint& b,
                              const ArrangedPoint& c) {
  points_.clear();
  triangles_.clear();
  triangle_at_.clear();
  links_.clear();
  aliases_.clear();
  last_ = 0;
  for (const ArrangedPoint* point : {&a, &b, &c}) add_point(*point);
  const bool is_left = turn_of(0, 1, 2) > 0;
  add_triangle({is_left ? std::array<uint32_t, 3>{0, 1, 2} : std::array<uint32_t, 3>{0, 2, 1}});
}

void PlanarSubdivision::start_around(const GridPoint& least, const GridPoint& most) {
  const auto u = static_cast<size_t>(u_axis(axis_));
  const auto v = static_cast<size_t>(v_axis(axis_));
  GridPoint right = least;
  right[u] = most[u];
  GridPoint top = least;
  top[v] = most[v];
  const PointName none = corner_name(kNoPlace);
  start(grid_point(none, least), grid_point(none, right), grid_point(none, most));
  const uint32_t point = add_point(grid_point(none, top));
  const uint32_t other = add_triangle({{0, 2, point}});
  triangles_[0].beyond[2] = other;
  triangles_[other].beyond[0] = 0;
}

uint32_t PlanarSubdivision::border_triangle() const {
  const auto is_at_border = [](const Triangle& triangle) {
    return std::ranges::find(triangle.beyond, kNoPlace) != triangle.beyond.end();
  };
  return static_cast<uint32_t>(std::ranges::find_if(triangles_, is_at_border) - triangles_.begin());
}

uint32_t PlanarSubdivision::add_point(const ArrangedPoint& point) {
  points_.push_back(point);
  triangle_at_.push_back(0);
  return static_cast<uint32_t>(points_.size() - 1);
}

uint32_t PlanarSubdivision::add_triangle(const Triangle& triangle) {
  const auto number = static_cast<uint32_t>(triangles_.size());
  triangles_.emplace_back();
  set(number, triangle);
  return number;
}

void PlanarSubdivision::set(uint32_t number, const Triangle& triangle) {
  triangles_[number] = triangle;
  for (const uint32_t point : triangle.points) triangle_at_[point] = number;
}

/// Where the triangle, which may be none, has `before` beyond an edge, it now has `after`.
void PlanarSubdivision::join(uint32_t triangle, uint32_t before, uint32_t after) {
  if (triangle != kNoPlace) triangles_[triangle].beyond[edge_towards(triangle, before)] = after;
}

size_t PlanarSubdivision::edge_towards(uint32_t triangle, uint32_t beyond) const {
  const auto& neighbors = triangles_[triangle].beyond;
  return static_cast<size_t>(std::ranges::find(neighbors, beyond) - neighbors.begin());
}

uint32_t PlanarSubdivision::insert(const ArrangedPoint& point) {
  // A walk towards the point may go in circles unless it starts with another edge now and then
  // (Devillers, Pion, Teillaud, "Walking in a triangulation", 2002).
  uint32_t at = last_;
  for (;;) {
    const Triangle& triangle = triangles_[at];
    const size_t first = (steps_++ * 0x9e3779b9u >> 16) % 3;
    std::array<int, 3> turns{};
    uint32_t next = kNoPlace;
    for (size_t i = 0; i < 3 && next == kNoPlace; ++i) {
      const size_t edge = (first + i) % 3;
      const uint32_t a = triangle.points[edge];
      const uint32_t b = triangle.points[(edge + 1) % 3];
      turns[edge] = turn(facets_, points_[a], points_[b], point, axis_);
      if (turns[edge] < 0) next = triangle.beyond[edge];
    }
    if (next != kNoPlace) {
      at = next;
      continue;
    }
    last_ = at;
    const auto zeros = std::ranges::count(turns, 0);
    if (zeros >= 2) {
      // Two edges pass through the point: their common corner is there.
      const size_t edge = turns[0] != 0 ? 2 : turns[1] != 0 ? 0 : 1;
      const uint32_t there = triangle.points[edge];
      if (points_[there].name != point.name) aliases_.push_back({there, point.name});
      return there;
    }
    const uint32_t number = add_point(point);
    if (zeros == 1) {
      divide_edge({at, static_cast<size_t>(std::ranges::find(turns, 0) - turns.begin())}, number);
    } else {
      divide_triangle(at, number);
    }
    make_delaunay(number);
    return number;
  }
}

void PlanarSubdivision::divide_triangle(uint32_t triangle, uint32_t point) {
  const Triangle old = triangles_[triangle];
  const std::array<uint32_t, 3> parts{triangle, static_cast<uint32_t>(triangles_.size()),
                                      static_cast<uint32_t>(triangles_.size() + 1)};
  triangles_.resize(triangles_.size() + 2);
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    set(parts[i], {{old.points[i], old.points[next], point},
                   {old.beyond[i], parts[next], parts[(i + 2) % 3]},
                   {old.lines[i], kNoPlace, kNoPlace}});
    join(old.beyond[i], triangle, parts[i]);
    suspicious_.push_back({parts[i], 0});
  }
}

void PlanarSubdivision::divide_edge(Place edge, uint32_t point) {
  // The triangle (a, b, c), and beyond its edge from a to b the triangle (b, a, d).
  const auto [here, i] = edge;
  const Triangle old = triangles_[here];
  const uint32_t there = old.beyond[i];
  const size_t j = (i + 1) % 3;
  const size_t k = (i + 2) % 3;
  const uint32_t line = old.lines[i];
  const uint32_t a = old.points[i];
  const uint32_t b = old.points[j];
  const uint32_t c = old.points[k];
  const auto half = static_cast<uint32_t>(triangles_.size());
  triangles_.emplace_back();
  const uint32_t other_half = there == kNoPlace ? kNoPlace : half + 1;
  set(here, {{a, point, c}, {other_half, half, old.beyond[k]}, {line, kNoPlace, old.lines[k]}});
  set(half, {{point, b, c}, {there, old.beyond[j], here}, {line, old.lines[j], kNoPlace}});
  join(old.beyond[j], here, half);
  suspicious_.push_back({here, 2});
  suspicious_.push_back({half, 1});
  if (there == kNoPlace) return;
  const Triangle other = triangles_[there];
  const size_t m = edge_towards(there, here);
  const size_t n = (m + 1) % 3;
  const size_t o = (m + 2) % 3;
  const uint32_t d = other.points[o];
  triangles_.emplace_back();
  set(there,
      {{b, point, d}, {half, other_half, other.beyond[o]}, {line, kNoPlace, other.lines[o]}});
  set(other_half,
      {{point, a, d}, {here, other.beyond[n], there}, {line, other.lines[n], kNoPlace}});
  join(other.beyond[n], there, other_half);
  suspicious_.push_back({there, 2});
  suspicious_.push_back({other_half, 1});
}

/// Returns whether the two triangles at the edge make a strictly convex quadrilateral.
bool PlanarSubdivision::can_flip(Place edge) const {
  const auto [here, i] = edge;
  const Triangle& triangle = triangles_[here];
  const uint32_t there = triangle.beyond[i];
  if (there == kNoPlace || triangle.lines[i] != kNoPlace) return false;
  const uint32_t a = triangle.points[i];
  const uint32_t b = triangle.points[(i + 1) % 3];
  const uint32_t c = triangle.points[(i + 2) % 3];
  const uint32_t d = triangles_[there].points[(edge_towards(there, here) + 2) % 3];
  return turn_of(c, a, d) > 0 && turn_of(d, b, c) > 0;
}

/// Makes (a, d, c) and (d, b, c) of (a, b, c) and (b, a, d).
void PlanarSubdivision::flip(Place edge) {
  const auto [here, i] = edge;
  const Triangle old = triangles_[here];
  const uint32_t there = old.beyond[i];
  const Triangle other = triangles_[there];
  const size_t m = edge_towards(there, here);
  const size_t j = (i + 1) % 3;
  const size_t k = (i + 2) % 3;
  const size_t n = (m + 1) % 3;
  const size_t o = (m + 2) % 3;
  const uint32_t a = old.points[i];
  const uint32_t b = old.points[j];
  const uint32_t c = old.points[k];
  const uint32_t d = other.points[o];
  set(here, {{a, d, c},
             {other.beyond[n], there, old.beyond[k]},
             {other.lines[n], kNoPlace, old.lines[k]}});
  set(there, {{d, b, c},
              {other.beyond[o], old.beyond[j], here},
              {other.lines[o], old.lines[j], kNoPlace}});
  join(other.beyond[n], there, here);
  join(old.beyond[j], here, there);
}

/// Rounding may err: only the quality of the triangles depends on it.
bool PlanarSubdivision::is_in_circle(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
  const glm::dvec2 center = drawn(points_[d], axis_);
  const glm::dvec2 p = drawn(points_[a], axis_) - center;
  const glm::dvec2 q = drawn(points_[b], axis_) - center;
  const glm::dvec2 r = drawn(points_[c], axis_) - center;
  const double pp = p.x * p.x + p.y * p.y;
  const double qq = q.x * q.x + q.y * q.y;
  const double rr = r.x * r.x + r.y * r.y;
  return pp * (q.x * r.y - q.y * r.x) + qq * (r.x * p.y - r.y * p.x) +
             rr * (p.x * q.y - p.y * q.x) >
         0;
}

/// Flips edges opposite to a new point (Lawson 1977). Each flip gives the point one edge more, so
/// that it ends whatever rounding does.
void PlanarSubdivision::make_delaunay(uint32_t point) {
  while (!suspicious_.empty()) {
    const Place edge = suspicious_.back();
    suspicious_.pop_back();
    const Triangle& triangle = triangles_[edge.triangle];
    const uint32_t there = triangle.beyond[edge.edge];
    if (there == kNoPlace || triangle.lines[edge.edge] != kNoPlace) continue;
    const uint32_t opposite =
        triangles_[there].points[(edge_towards(there, edge.triangle) + 2) % 3];
    const auto& [a, b, c] = triangle.points;
    if (!is_in_circle(a, b, c, opposite) || !can_flip(edge)) continue;
    flip(edge);
    for (const uint32_t number : {edge.triangle, there}) {
      const auto& points = triangles_[number].points;
      const auto at = static_cast<size_t>(std::ranges::find(points, point) - points.begin());
      suspicious_.push_back({number, (at + 1) % 3});
    }
  }
}

/// Calls visit(triangle, index of the point in it) for the triangles around the point until it
/// returns true.
template <class Visit>
void PlanarSubdivision::visit_around(uint32_t point, Visit visit) const {
  const auto index_in = [&](uint32_t triangle) {
    const auto& points = triangles_[triangle].points;
    return static_cast<size_t>(std::ranges::find(points, point) - points.begin());
  };
  const uint32_t first = triangle_at_[point];
  uint32_t at = first;
  do {  // counterclockwise, over the edge that ends in the point
    const size_t i = index_in(at);
    if (visit(at, i)) return;
    at = triangles_[at].beyond[(i + 2) % 3];
  } while (at != first && at != kNoPlace);
  if (at == first) return;
  for (at = triangles_[first].beyond[index_in(first)]; at != kNoPlace;) {
    const size_t i = index_in(at);
    if (visit(at, i)) return;
    at = triangles_[at].beyond[i];
  }
}

/// Returns a triangle's edge from one point to the other, or from that to the first at the border;
/// a triangle kNoPlace: they have none.
PlanarSubdivision::Place PlanarSubdivision::find_edge(uint32_t from, uint32_t to) const {
  Place result{kNoPlace, 0};
  visit_around(from, [&](uint32_t triangle, size_t i) {
    const auto& points = triangles_[triangle].points;
    if (points[(i + 1) % 3] == to) {
      result = {triangle, i};
    } else if (points[(i + 2) % 3] == to) {
      result = {triangle, (i + 2) % 3};
    }
    return result.triangle != kNoPlace;
  });
  return result;
}

/// A segment passes each edge once: the edge does not have the line.
void PlanarSubdivision::add_line(Place edge, uint32_t line) {
  Triangle& triangle = triangles_[edge.triangle];
  links_.push_back({line, triangle.lines[edge.edge]});
  const auto first = static_cast<uint32_t>(links_.size() - 1);
  triangle.lines[edge.edge] = first;
  const uint32_t there = triangle.beyond[edge.edge];
  if (there != kNoPlace) triangles_[there].lines[edge_towards(there, edge.triangle)] = first;
}

void PlanarSubdivision::draw(uint32_t from, uint32_t to, uint32_t line) {
  if (from == to) return;
  open_.push_back({from, to, line});
  while (!open_.empty()) {
    const Segment segment = open_.back();
    open_.pop_back();
    draw_step(segment);
  }
}

/// Draws the segment up to the first point or line that it meets; the rest becomes open.
void PlanarSubdivision::draw_step(const Segment& segment) {
  const uint32_t from = segment.from;
  const uint32_t to = segment.to;
  const uint32_t line = segment.line;
  Place edge{kNoPlace, 0};      // along which the segment starts
  uint32_t through = kNoPlace;  // the triangle through which it starts
  size_t corner = 0;            // its corner there
  visit_around(from, [&](uint32_t number, size_t i) {
    const auto& points = triangles_[number].points;
    const uint32_t p = points[(i + 1) % 3];
    const uint32_t q = points[(i + 2) % 3];
    if (p == to || q == to) {
      edge = {number, p == to ? i : (i + 2) % 3};
      return true;
    }
    const int at_p = turn_of(from, p, to);
    const int at_q = turn_of(from, q, to);
    if (at_p > 0 && at_q < 0) {
      through = number;
      corner = i;
      return true;
    }
    // The other corner tells whether a point on the line is ahead or behind.
    if (at_p == 0 && at_q < 0) {
      edge = {number, i};
      return true;
    }
    if (at_q == 0 && at_p > 0) {
      edge = {number, (i + 2) % 3};
      return true;
    }
    return false;
  });
  if (edge.triangle != kNoPlace) {
    const auto& points = triangles_[edge.triangle].points;
    const uint32_t a = points[edge.edge];
    const uint32_t next = a == from ? points[(edge.edge + 1) % 3] : a;
    add_line(edge, line);
    if (next != to) open_.push_back({next, to, line});
    return;
  }
  assert(through != kNoPlace);
  if (through == kNoPlace) return;
  std::vector<std::array<uint32_t, 2>> crossed;
  Place at{through, (corner + 1) % 3};
  for (;;) {
    const Triangle& triangle = triangles_[at.triangle];
    const uint32_t right = triangle.points[at.edge];
    const uint32_t left = triangle.points[(at.edge + 1) % 3];
    if (triangle.lines[at.edge] != kNoPlace) {
      std::vector<PointName> names;
      const ArrangedPoint point = meet_(line, links_[triangle.lines[at.edge]].line, names);
      const uint32_t number = add_point(point);
      for (const PointName& name : names) aliases_.push_back({number, name});
      divide_edge(at, number);
      make_delaunay(number);
      open_.push_back({number, to, line});
      open_.push_back({from, number, line});
      return;
    }
    crossed.push_back({right, left});
    const uint32_t there = triangle.beyond[at.edge];
    const size_t edge_there = edge_towards(there, at.triangle);
    const uint32_t apex = triangles_[there].points[(edge_there + 2) % 3];
    const int apex_turn = apex == to ? 0 : turn_of(from, to, apex);
    if (apex_turn == 0) {
      const Segment part{from, apex, line};
      clear_way(crossed, part);
      add_line(find_edge(from, apex), line);
      if (apex != to) open_.push_back({apex, to, line});
      return;
    }
    // From `there`, the shared edge runs from left to right, then to the apex.
    at = {there, (edge_there + (apex_turn > 0 ? 1u : 2u)) % 3};
  }
}

/// Flips the edges that the segment crosses until none of them does (Sloan, "A fast algorithm for
/// generating constrained Delaunay triangulations", 1993).
void PlanarSubdivision::clear_way(std::vector<std::array<uint32_t, 2>>& crossed,
                                  const Segment& segment) {
  const auto [from, to, line] = segment;
  for (size_t i = 0; i < crossed.size(); ++i) {
    const auto [a, b] = crossed[i];
    const Place edge = find_edge(a, b);
    if (!can_flip(edge)) {
      crossed.push_back({a, b});
      continue;
    }
    flip(edge);
    // The new edge is the one from the second point to the third of the first triangle.
    const auto& points = triangles_[edge.triangle].points;
    const uint32_t p = points[1];
    const uint32_t q = points[2];
    if (p == from || p == to || q == from || q == to) continue;
    if (turn_of(from, to, p) * turn_of(from, to, q) < 0) crossed.push_back({p, q});
  }
}

}  // namespace csgcore
