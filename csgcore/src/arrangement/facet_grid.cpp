#include "arrangement/facet_grid.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>
#include <utility>

namespace csgcore {
namespace {

/// Numbers points, equal ones alike. An open table is several times as fast as a std::
/// unordered_map, and half of the time of a large mesh's rounding goes into this.
class PointNumbers {
 public:
  PointNumbers(std::vector<GridPoint>& points, size_t most)
      : points_(points), slots_(std::bit_ceil(2 * most + 1), kNoPlace) {}

  /// Tells the processor that the point will be asked for.
  void announce(const GridPoint& point) const { hwy::Prefetch(&slots_[slot_of(point)]); }

  uint32_t number(const GridPoint& point) {
    size_t slot = slot_of(point);
    while (slots_[slot] != kNoPlace) {
      if (points_[slots_[slot]] == point) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<uint32_t>(points_.size());
    points_.push_back(point);
    return slots_[slot];
  }

 private:
  size_t slot_of(const GridPoint& point) const {
    uint64_t hash = 0;
    for (const int64_t x : point) {
      hash = (hash ^ static_cast<uint64_t>(x)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash & (slots_.size() - 1);
  }

  std::vector<GridPoint>& points_;
  std::vector<uint32_t> slots_;
};

/// Sets the map to the grid.
void set_grid(Facets& facets, Surfaces operands) {
  Box box;
  for (const TriangleSet* operand : operands) {
    for (const Vec3& vertex : operand->vertices) box.merge(vertex);
  }
  if (box.empty()) return;
  const auto largest = [](const Vec3& x) { return std::max({x.x, x.y, x.z}); };
  const double half = largest(box.max / 2.0 - box.min / 2.0);
  double reach = largest(glm::max(glm::abs(box.min), glm::abs(box.max)));
  // Far away from the origin digits would be lost. Near it, numbers of few binary digits stay what
  // they are if it is in the grid.
  constexpr double kFar = 4;
  if (reach > kFar * half) {
    facets.middle = box.min / 2.0 + box.max / 2.0;
    reach = largest(glm::max(facets.middle - box.min, box.max - facets.middle));
  }
  if (!(reach > 0)) return;
  // Beyond double's largest power of two nothing is told apart.
  constexpr int kLargest = std::numeric_limits<double>::max_exponent - 1;
  facets.scale = std::ldexp(1.0, std::min(kGridBits - 1 - std::ilogb(reach), kLargest));
}

bool are_on_line(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return plane_through(a, b, c).normal == std::array<Int128, 3>{};
}

/// A coordinate may be off the grid where the box of all is beyond double's range.
int64_t on_grid(double x) {
  constexpr double kMost = 0x1p39;
  static_assert(kMost == static_cast<double>(int64_t{1} << kGridBits));
  return std::isfinite(x) ? std::llrint(std::clamp(x, -kMost, kMost)) : 0;
}

using Edge = std::pair<uint32_t, uint32_t>;
Edge edge_of(uint32_t a, uint32_t b) { return std::minmax(a, b); }

/// A triangle whose corners are different, but on a line, has the inner one on its longest edge.
/// Whatever is beyond that edge is touched there.
void find_touches(Facets& result, std::vector<Facet> flat) {
  if (flat.empty()) return;
  struct Hash {
    size_t operator()(const Edge& edge) const {
      return (uint64_t{edge.first} << 32 | edge.second) * 0x9e3779b97f4a7c15u >> 13;
    }
  };
  std::unordered_multimap<Edge, uint32_t, Hash> facets_at;  // the facets of each edge
  std::unordered_multimap<Edge, uint32_t, Hash> flat_at;    // and those without area
  for (uint32_t i = 0; i < flat.size(); ++i) {
    const auto& [a, b, c] = flat[i].corners;
    for (const Edge& edge : {edge_of(a, b), edge_of(b, c), edge_of(c, a)}) flat_at.emplace(edge, i);
  }
  for (uint32_t i = 0; i < result.facets.size(); ++i) {
    const auto& [a, b, c] = result.facets[i].corners;
    for (const Edge& edge : {edge_of(a, b), edge_of(b, c), edge_of(c, a)}) {
      if (flat_at.contains(edge)) facets_at.emplace(edge, i);
    }
  }
  const auto is_between = [&](uint32_t a, uint32_t x, uint32_t b) {
    const auto& p = result.points;
    return are_on_line(p[a], p[x], p[b]) && std::min(p[a], p[b]) < p[x] &&
           p[x] < std::max(p[a], p[b]);
  };
  std::vector<std::pair<Edge, uint32_t>> open;
  std::vector<std::pair<Edge, uint32_t>> done;
  for (const Facet& facet : flat) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = facet.corners[i];
      const uint32_t b = facet.corners[(i + 1) % 3];
      const uint32_t x = facet.corners[(i + 2) % 3];
      if (is_between(a, x, b)) open.push_back({edge_of(a, b), x});
    }
  }
  while (!open.empty()) {
    const auto [edge, x] = open.back();
    open.pop_back();
    if (std::ranges::find(done, std::pair(edge, x)) != done.end()) continue;
    done.emplace_back(edge, x);
    const auto [first, last] = facets_at.equal_range(edge);
    for (auto at = first; at != last; ++at) result.touches.push_back({at->second, x});
    // The other two edges of a triangle without area cover the edge: one of them holds the point.
    const auto [first_flat, last_flat] = flat_at.equal_range(edge);
    for (auto at = first_flat; at != last_flat; ++at) {
      const auto& [a, b, c] = flat[at->second].corners;
      for (const Edge& other : {edge_of(a, b), edge_of(b, c), edge_of(c, a)}) {
        if (other != edge && is_between(other.first, x, other.second)) open.push_back({other, x});
      }
    }
  }
  std::ranges::sort(result.touches, {},
                    [](const Facets::Touch& touch) { return std::pair(touch.facet, touch.point); });
}

}  // namespace

bool Facets::are_in_one_plane(uint32_t a, uint32_t b) const {
  const GridPlane plane_of_a = plane(a);
  return std::ranges::all_of(
      corners(b), [&](const GridPoint& corner) { return side(plane_of_a, corner) == 0; });
}

Facets facets_on_grid(Surfaces operands) {
  Facets result;
  set_grid(result, operands);
  size_t vertices = 0;
  size_t triangles = 0;
  for (const TriangleSet* operand : operands) {
    vertices += operand->vertices.size();
    triangles += operand->triangles.size();
  }
  result.points.reserve(vertices);
  result.facets.reserve(triangles);
  PointNumbers numbers(result.points, vertices);
  std::vector<Facet> flat;
  std::vector<GridPoint> rounded;
  std::vector<uint32_t> number_of;
  for (uint32_t i = 0; i < operands.size(); ++i) {
    const std::vector<Vec3>& all = operands[i]->vertices;
    rounded.resize(all.size());
    for (size_t j = 0; j < all.size(); ++j) {
      const Vec3 scaled = (all[j] - result.middle) * result.scale;
      rounded[j] = {on_grid(scaled.x), on_grid(scaled.y), on_grid(scaled.z)};
    }
    number_of.resize(all.size());
    for (size_t j = 0; j < all.size(); ++j) {
      constexpr size_t kAhead = 16;  // as many as memory gives at once
      if (j + kAhead < all.size()) numbers.announce(rounded[j + kAhead]);
      number_of[j] = numbers.number(rounded[j]);
    }
    for (const auto& triangle : operands[i]->triangles) {
      const Facet facet{{number_of[triangle[0]], number_of[triangle[1]], number_of[triangle[2]]},
                        i};
      const auto& [a, b, c] = facet.corners;
      if (a == b || b == c || c == a) continue;
      const auto& points = result.points;
      (are_on_line(points[a], points[b], points[c]) ? flat : result.facets).push_back(facet);
    }
  }
  find_touches(result, std::move(flat));
  return result;
}

PointName corner_name(uint32_t corner) { return {{PointName::kCorner, corner}}; }

PointName name_of(uint32_t a, uint32_t b, uint32_t facet) {
  return {{PointName::kEdgeAndFacet, std::min(a, b), std::max(a, b), facet}};
}

PointName name_of_edges(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  Edge first = edge_of(a, b);
  Edge second = edge_of(c, d);
  if (second < first) std::swap(first, second);
  return {{PointName::kEdgeAndEdge, first.first, first.second, second.first, second.second}};
}

PointName name_of_planes(uint32_t p, uint32_t q, uint32_t r) {
  std::array<uint32_t, 3> planes{p, q, r};
  std::ranges::sort(planes);
  return {{PointName::kThreeFacets, planes[0], planes[1], planes[2]}};
}

}  // namespace csgcore
