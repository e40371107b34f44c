#include "meshes/triangulation.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <utility>

#include "meshes/delaunay.hpp"
#include "meshes/planar_predicates.hpp"

namespace frontend {
namespace {

using glm::dvec2;
using Triangle = std::array<uint32_t, 3>;
using CornerNumbers = std::span<const uint32_t>;
using Places = std::span<const dvec2>;
using Ends = std::span<const uint32_t>;

/// The work that the triangulation of a polygon may take, three times. Circles take 3 steps for
/// each corner, and stars of 10,000 corners 100. What takes more is not Delaunay's in all places. A
/// step takes 0.1 µs.
constexpr uint64_t kStepsPerCorner = 16, kFreeSteps = 1 << 20;

/// Calls visit(i, k) for each edge of the polygons, from corner i to corner k.
template <typename Visit>
void visit_ring_edges(Ends ends, const Visit& visit) {
  uint32_t first = 0;
  for (const uint32_t end : ends) {
    for (uint32_t i = first; i < end; ++i) visit(i, i + 1 < end ? i + 1 : first);
    first = end;
  }
}

void add_fan(CornerNumbers corners, std::vector<Triangle>& triangles) {
  for (size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

bool is_less(const dvec2& a, const dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Returns the corner, 0 or 1, that a diagonal of the quadrilateral begins at; none if it crosses
/// itself, or runs clockwise.
std::optional<size_t> diagonal_of(Places places) {
  const auto at = [&](size_t i) -> const dvec2& { return places[i % 4]; };
  size_t other = 4;  // the only corner at which it does not turn left
  for (size_t i = 0; i < 4; ++i) {
    if (orientation(at(i + 3), at(i), at(i + 1)) > 0) continue;
    if (other < 4) return std::nullopt;
    other = i;
  }
  if (other < 4) return other % 2;
  const int inside = in_circle(at(0), at(1), at(2), at(3));
  if (inside != 0) return inside > 0 ? 1 : 0;
  size_t least = 0;
  for (size_t i = 1; i < 4; ++i) {
    if (is_less(at(i), at(least))) least = i;
  }
  return (least + 1) % 2;
}

/// The different vertices of polygons in the order of the triangulation.
struct SortedVertices {
  std::vector<uint32_t> numbers;  // as the polygons' corners have them
  std::vector<dvec2> points;
  std::vector<uint32_t> ranks;  // by corner of the polygons: its vertex here
  bool has_twins = false;       // two vertices are at one place

  SortedVertices(CornerNumbers corners, Places places) : ranks(corners.size()) {
    std::vector<uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return places[a] == places[b] ? corners[a] < corners[b] : is_less(places[a], places[b]);
    });
    for (const uint32_t corner : order) {
      if (numbers.empty() || numbers.back() != corners[corner]) {
        numbers.push_back(corners[corner]);
        points.push_back(places[corner]);
      }
      ranks[corner] = static_cast<uint32_t>(numbers.size() - 1);
    }
    has_twins = std::adjacent_find(points.begin(), points.end()) != points.end();
  }

  bool are_on_a_line() const {
    for (size_t i = 2; i < points.size(); ++i) {
      if (orientation(points[0], points[1], points[i]) != 0) return false;
    }
    return true;
  }
};

/// The directed edges of polygons, to be counted.
class EdgeCounts {
 public:
  EdgeCounts(std::span<const uint32_t> ranks, Ends ends) {
    visit_ring_edges(ends,
                     [&](uint32_t i, uint32_t k) { edges_.emplace_back(ranks[i], ranks[k]); });
    std::sort(edges_.begin(), edges_.end());
  }
  /// Returns how often the polygons run from a to b, less how often they run back.
  int64_t along(uint32_t a, uint32_t b) const { return count(a, b) - count(b, a); }

 private:
  int64_t count(uint32_t a, uint32_t b) const {
    const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), std::pair(a, b));
    return last - first;
  }
  std::vector<std::pair<uint32_t, uint32_t>> edges_;
};

/// Returns how often the polygons wind around each triangle.
std::vector<int64_t> windings_of(const DelaunayTriangulation& delaunay, const EdgeCounts& edges) {
  constexpr int64_t kUnknown = INT64_MIN;
  std::vector<int64_t> windings(delaunay.sides() / 3, kUnknown);
  std::vector<uint32_t> open;
  const auto enter = [&](uint32_t side, int64_t outside) {
    int64_t& winding = windings[side / 3];
    if (winding != kUnknown) return;
    winding = outside + edges.along(delaunay.origin(side), delaunay.origin(delaunay.next(side)));
    open.push_back(side / 3);
  };
  for (uint32_t side = 0; side < delaunay.sides(); ++side) {
    if (delaunay.twin(side) == DelaunayTriangulation::kNone) enter(side, 0);
  }
  while (!open.empty()) {
    const uint32_t triangle = open.back();
    open.pop_back();
    for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
      if (delaunay.twin(side) != DelaunayTriangulation::kNone) {
        enter(delaunay.twin(side), windings[triangle]);
      }
    }
  }
  return windings;
}

/// Returns false, and appends nothing, if the polygons have no constrained Delaunay triangulation,
/// or it would take too long.
bool add_delaunay(CornerNumbers corners, Ends ends, Places places,
                  std::vector<Triangle>& triangles) {
  const SortedVertices sorted(corners, places);
  if (sorted.has_twins || sorted.are_on_a_line()) return false;
  DelaunayTriangulation delaunay(sorted.points, kFreeSteps + kStepsPerCorner * corners.size());
  bool is_constrained = true;
  visit_ring_edges(ends, [&](uint32_t i, uint32_t k) {
    is_constrained = is_constrained && delaunay.constrain(sorted.ranks[i], sorted.ranks[k]);
  });
  if (!is_constrained) return false;
  delaunay.flip_to_delaunay();
  const std::vector<int64_t> windings = windings_of(delaunay, EdgeCounts(sorted.ranks, ends));
  for (uint32_t t = 0; t < windings.size(); ++t) {
    Triangle triangle;
    for (uint32_t k = 0; k < 3; ++k) triangle[k] = sorted.numbers[delaunay.origin(3 * t + k)];
    if (windings[t] < 0) std::swap(triangle[1], triangle[2]);
    triangles.insert(triangles.end(), static_cast<size_t>(std::abs(windings[t])), triangle);
  }
  return true;
}

}  // namespace

void triangulate(CornerNumbers corners, Places places, std::vector<Triangle>& triangles) {
  if (corners.size() == 4) {
    if (const std::optional<size_t> first = diagonal_of(places)) {
      const auto at = [&](size_t i) { return corners[(*first + i) % 4]; };
      triangles.push_back({at(0), at(1), at(2)});
      triangles.push_back({at(0), at(2), at(3)});
      return;
    }
  }
  const std::array<uint32_t, 1> end{static_cast<uint32_t>(corners.size())};
  if (corners.size() > 3 && add_delaunay(corners, end, places, triangles)) return;
  add_fan(corners, triangles);
}

void triangulate_all(CornerNumbers corners, Ends ends, Places places,
                     std::vector<Triangle>& triangles) {
  if (ends.size() > 1 && add_delaunay(corners, ends, places, triangles)) return;
  size_t first = 0;
  for (const uint32_t end : ends) {
    triangulate(corners.subspan(first, end - first), places.subspan(first, end - first), triangles);
    first = end;
  }
}

void triangulate_all_reversed(CornerNumbers corners, Ends ends, Places places,
                              std::vector<Triangle>& triangles) {
  const size_t first = triangles.size();
  triangulate_all(corners, ends, places, triangles);
  for (size_t i = first; i < triangles.size(); ++i) std::swap(triangles[i][0], triangles[i][1]);
}

}  // namespace frontend
