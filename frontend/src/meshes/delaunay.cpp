#include "meshes/delaunay.hpp"

#include <algorithm>
#include <deque>
#include <glm/geometric.hpp>
#include <utility>

#include "csgcore/stop_scope.hpp"
#include "meshes/planar_predicates.hpp"

namespace frontend {

DelaunayTriangulation::DelaunayTriangulation(std::span<const glm::dvec2> points,
                                             uint64_t most_steps)
    : points_(points),
      most_steps_(most_steps),
      steps_left_(most_steps),
      side_from_(points.size(), kNone) {
  sweep();
  flip_to_delaunay();
}

int DelaunayTriangulation::turn(uint32_t a, uint32_t b, uint32_t c) const {
  return orientation(points_[a], points_[b], points_[c]);
}

/// Returns the side from a to b.
uint32_t DelaunayTriangulation::add_triangle(uint32_t a, uint32_t b, uint32_t c) {
  const uint32_t side = sides();
  for (const uint32_t vertex : {a, b, c}) {
    side_from_[vertex] = sides();
    origin_.push_back(vertex);
    twin_.push_back(kNone);
    is_constraint_.push_back(0);
  }
  return side;
}

void DelaunayTriangulation::link(uint32_t side, uint32_t other) {
  twin_[side] = other;
  if (other != kNone) twin_[other] = side;
}

/// Adds one point after another, with a triangle for each edge of the hull that it sees.
void DelaunayTriangulation::sweep() {
  const auto count = static_cast<uint32_t>(points_.size());
  uint32_t apex = 2;  // the first point that is not on a line with those before
  while (turn(0, 1, apex) == 0) ++apex;
  const bool is_left = turn(0, 1, apex) > 0;
  // The hull, counterclockwise: by vertex, the next one, the one before, and the side between it
  // and the next one.
  std::vector<uint32_t> after(count), before(count), side_after(count);
  const auto join = [&](uint32_t from, uint32_t to, uint32_t side) {
    after[from] = to;
    before[to] = from;
    side_after[from] = side;
  };
  uint32_t last = kNone;  // the side from the apex to the point before
  for (uint32_t i = 0; i + 1 < apex; ++i) {
    if (is_left) {
      const uint32_t side = add_triangle(i, i + 1, apex);
      link(next(next(side)), last);
      last = next(side);
      join(i, i + 1, side);
      if (i == 0) join(apex, 0, previous(side));
      if (i + 2 == apex) join(i + 1, apex, next(side));
    } else {
      const uint32_t side = add_triangle(i + 1, i, apex);
      link(next(side), last);
      last = previous(side);
      join(i + 1, i, side);
      if (i == 0) join(0, apex, next(side));
      if (i + 2 == apex) join(apex, i + 1, previous(side));
    }
  }
  for (uint32_t point = apex + 1; point < count; ++point) {
    csgcore::stop_point();
    // The point before is on the hull, and is seen from here.
    uint32_t first = point - 1, end = point - 1;
    while (turn(before[first], first, point) < 0) first = before[first];
    while (turn(end, after[end], point) < 0) end = after[end];
    uint32_t left = kNone;  // the side from the point to the vertex at hand
    uint32_t entry = kNone, exit = kNone;
    for (uint32_t vertex = first; vertex != end;) {
      const uint32_t following = after[vertex];
      const uint32_t side = add_triangle(following, vertex, point);
      link(side, side_after[vertex]);
      if (left == kNone) {
        entry = next(side);
      } else {
        link(next(side), left);
      }
      left = exit = previous(side);
      vertex = following;
    }
    join(first, point, entry);
    join(point, end, exit);
  }
}

/// Turns the edge within the quadrilateral of its two triangles.
void DelaunayTriangulation::flip(uint32_t side) {
  const uint32_t twin = twin_[side];
  const uint32_t a = next(side), b = previous(side);  // of one triangle
  const uint32_t c = next(twin), d = previous(twin);  // of the other
  // The side becomes that from the far corner of the other triangle to that of its own; b and d
  // stay.
  const uint32_t near = origin_[b], far = origin_[d];
  const uint32_t start = origin_[side], finish = origin_[twin];
  const uint32_t beyond_a = twin_[a], beyond_c = twin_[c];
  const uint8_t constraint_a = is_constraint_[a], constraint_c = is_constraint_[c];
  // Triangle (start, far, near): sides c' = start → far in place of `side`, far → near in `a`, b.
  origin_[side] = start;
  origin_[a] = far;
  origin_[b] = near;
  link(side, beyond_c);
  is_constraint_[side] = constraint_c;
  // Triangle (finish, near, far): finish → near in place of `twin`, near → far in `c`, d.
  origin_[twin] = finish;
  origin_[c] = near;
  origin_[d] = far;
  link(twin, beyond_a);
  is_constraint_[twin] = constraint_a;
  link(a, c);
  is_constraint_[a] = is_constraint_[c] = 0;
  side_from_[start] = side;
  side_from_[finish] = twin;
  side_from_[far] = a;
  side_from_[near] = c;
}

/// Returns whether the two triangles beside the edge form a strictly convex quadrilateral.
bool DelaunayTriangulation::is_flippable(uint32_t side) const {
  const uint32_t near = origin_[previous(side)], far = origin_[previous(twin_[side])];
  return turn(far, target(side), near) > 0 && turn(near, origin_[side], far) > 0;
}

bool DelaunayTriangulation::is_delaunay(uint32_t side) const {
  const uint32_t a = origin_[side], b = target(side), near = origin_[previous(side)],
                 far = origin_[previous(twin_[side])];
  const int inside = in_circle(points_[a], points_[b], points_[near], points_[far]);
  // Of four points on a circle the least has no edge to the one opposite.
  if (inside == 0) return std::min(a, b) > std::min(near, far);
  return inside < 0;
}

void DelaunayTriangulation::flip_to_delaunay() {
  steps_left_ = most_steps_;
  std::vector<uint32_t> open(sides());
  for (uint32_t side = 0; side < sides(); ++side) open[side] = side;
  while (!open.empty()) {
    csgcore::stop_point();
    const uint32_t side = open.back();
    open.pop_back();
    const uint32_t twin = twin_[side];
    if (twin == kNone || is_constraint_[side] != 0 || is_delaunay(side) || !is_flippable(side)) {
      continue;
    }
    if (!use_step()) break;
    flip(side);
    for (const uint32_t changed : {side, previous(side), twin, previous(twin)}) {
      open.push_back(changed);
    }
  }
  steps_left_ = most_steps_;
}

/// Finds the sides that the edge crosses; none if it is one already. Returns false if a vertex or a
/// constraint is in the way.
bool DelaunayTriangulation::find_crossings(uint32_t from, uint32_t to,
                                           std::vector<uint32_t>& crossed) {
  crossed.clear();
  // Around `from`, first counterclockwise up to the hull, then the other way.
  uint32_t first = side_from_[from];
  uint32_t side = first;
  bool turns_back = false;
  uint32_t crossing = kNone;
  while (crossing == kNone) {
    if (!use_step()) return false;
    const uint32_t right = target(side), left = origin_[previous(side)];
    if (right == to || left == to) {
      const uint32_t edge = right == to ? side : previous(side);
      is_constraint_[edge] = 1;
      if (twin_[edge] != kNone) is_constraint_[twin_[edge]] = 1;
      return true;
    }
    const int of_right = turn(from, to, right), of_left = turn(from, to, left);
    if (of_right < 0 && of_left > 0) {
      crossing = next(side);
      break;
    }
    const glm::dvec2 way = points_[to] - points_[from];
    const auto is_ahead = [&](uint32_t vertex, int of_vertex) {
      return of_vertex == 0 && glm::dot(points_[vertex] - points_[from], way) > 0;
    };
    if (is_ahead(right, of_right) || is_ahead(left, of_left)) return false;
    if (!turns_back) {
      const uint32_t onwards = twin_[previous(side)];
      if (onwards != kNone && onwards != first) {
        side = onwards;
        continue;
      }
      if (onwards == first) return false;
      turns_back = true;
      side = first;
    }
    if (twin_[side] == kNone) return false;
    side = next(twin_[side]);
    if (side == first) return false;
  }
  for (;;) {
    if (!use_step() || is_constraint_[crossing] != 0) return false;
    crossed.push_back(crossing);
    const uint32_t beyond = twin_[crossing];
    if (beyond == kNone) return false;
    const uint32_t vertex = origin_[previous(beyond)];
    if (vertex == to) return true;
    const int of_vertex = turn(from, to, vertex);
    if (of_vertex == 0) return false;
    // `beyond` runs from the left of the edge to its right.
    crossing = of_vertex > 0 ? next(beyond) : previous(beyond);
  }
}

/// Returns a side between two vertices that have an edge.
uint32_t DelaunayTriangulation::side_between(uint32_t a, uint32_t b) const {
  const uint32_t first = side_from_[a];
  for (uint32_t side = first;;) {  // counterclockwise up to the hull
    if (target(side) == b) return side;
    if (origin_[previous(side)] == b) return previous(side);
    side = twin_[previous(side)];
    if (side == kNone || side == first) break;
  }
  for (uint32_t side = first; twin_[side] != kNone;) {
    side = next(twin_[side]);
    if (target(side) == b) return side;
  }
  return kNone;
}

/// Flips the edges in the way, and those that are in the way still, until none is (Sloan, "A fast
/// algorithm for generating constrained Delaunay triangulations", 1993).
bool DelaunayTriangulation::constrain(uint32_t from, uint32_t to) {
  std::vector<uint32_t> crossed;
  if (!find_crossings(from, to, crossed)) return false;
  if (crossed.empty()) return true;
  // A flip moves other edges to other sides, so that edges are named by their ends.
  std::deque<std::pair<uint32_t, uint32_t>> open;
  for (const uint32_t side : crossed) open.emplace_back(origin_[side], target(side));
  while (!open.empty()) {
    if (!use_step()) return false;
    const auto ends = open.front();
    open.pop_front();
    const uint32_t side = side_between(ends.first, ends.second);
    if (side == kNone) return false;
    if (!is_flippable(side)) {
      open.push_back(ends);
      continue;
    }
    flip(side);
    const uint32_t far = target(side), near = origin_[previous(side)];
    if (turn(from, to, far) * turn(from, to, near) < 0) open.emplace_back(far, near);
  }
  return find_crossings(from, to, crossed) && crossed.empty();
}

}  // namespace frontend
