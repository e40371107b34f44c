#include "arrangement/manifold_edges.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "arrangement/disjoint_sets.hpp"
#include "arrangement/facet_grid.hpp"
#include "arrangement/sorted_by_key.hpp"

namespace csgcore {
namespace {

struct HalfEdge {
  uint32_t low;  // its ends
  uint32_t high;
  uint32_t triangle;
  uint32_t corner;  // of the triangle, where it starts
  auto operator<=>(const HalfEdge&) const = default;
};

class Parting {
 public:
  Parting(BoundaryMesh& mesh, const std::vector<bool>& may_touch, const AreOnLine& are_on_line)
      : mesh_(mesh), may_touch_(may_touch), are_on_line_(are_on_line) {}

  void run() {
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const auto& triangle = mesh_.triangles[i];
      if (std::ranges::none_of(triangle, [&](uint32_t vertex) { return may_touch_[vertex]; })) {
        continue;
      }
      place_of_.push_back(i);
    }
    std::vector<HalfEdge> edges = sorted_edges();
    while (close_junctions(edges)) edges = sorted_edges();
    DisjointSets fans(3 * place_of_.size());  // of corners
    for (size_t begin = 0; begin < edges.size();) {
      const size_t end = end_of_equal(edges, begin);
      if (end - begin == 2) {
        join(fans, edges[begin], edges[begin + 1]);
      } else {
        join_around({edges.begin() + static_cast<std::ptrdiff_t>(begin),
                     edges.begin() + static_cast<std::ptrdiff_t>(end)},
                    fans);
      }
      begin = end;
    }
    copy_vertices(fans);
    divide_edges();
  }

 private:
  uint32_t vertex(uint32_t place, uint32_t corner) const {
    return mesh_.triangles[place_of_[place]][corner % 3];
  }
  static uint32_t corner_of(const HalfEdge& edge, uint32_t beyond) {
    return 3 * edge.triangle + (edge.corner + beyond) % 3;
  }
  std::vector<HalfEdge> sorted_edges() const {
    std::vector<HalfEdge> edges;
    for (uint32_t i = 0; i < place_of_.size(); ++i) {
      for (uint32_t j = 0; j < 3; ++j) {
        const uint32_t from = vertex(i, j);
        const uint32_t to = vertex(i, j + 1);
        if (!may_touch_[from] && !may_touch_[to]) continue;
        edges.push_back({std::min(from, to), std::max(from, to), i, j});
      }
    }
    sort_by_key(edges, mesh_.vertices.size(), [](const HalfEdge& edge) { return edge.low; });
    return edges;
  }

  /// Returns where the edges with the ends of edges[begin] end.
  static size_t end_of_equal(const std::vector<HalfEdge>& edges, size_t begin) {
    size_t end = begin + 1;
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high) {
      ++end;
    }
    return end;
  }

  bool is_rising(const HalfEdge& edge) const {
    return vertex(edge.triangle, edge.corner) == edge.low;
  }
  uint32_t start(const HalfEdge& edge) const { return is_rising(edge) ? edge.low : edge.high; }
  uint32_t end(const HalfEdge& edge) const { return is_rising(edge) ? edge.high : edge.low; }

  /// Returns the edges, by their starts, that more triangles pass one way than the other.
  std::multimap<uint32_t, HalfEdge> open_edges(const std::vector<HalfEdge>& edges) const {
    std::multimap<uint32_t, HalfEdge> result;
    for (size_t begin = 0; begin < edges.size();) {
      const size_t end = end_of_equal(edges, begin);
      std::vector<HalfEdge> more;
      for (size_t i = begin; i < end; ++i) {
        if (more.empty() || is_rising(more.back()) == is_rising(edges[i])) {
          more.push_back(edges[i]);
        } else {
          more.pop_back();
        }
      }
      for (const HalfEdge& edge : more) result.emplace(start(edge), edge);
      begin = end;
    }
    return result;
  }

  /// Where faces on both sides of a straight edge have different points on it, divides their
  /// triangles there, each at most once. Returns whether there were any.
  bool close_junctions(const std::vector<HalfEdge>& edges) {
    std::multimap<uint32_t, HalfEdge> open = open_edges(edges);
    std::set<uint32_t> divided;  // triangles
    while (!open.empty()) {
      std::vector<HalfEdge> way{open.begin()->second};
      open.erase(open.begin());
      const uint32_t first = start(way[0]);
      const uint32_t second = end(way[0]);
      while (end(way.back()) != first) {
        auto [at, last] = open.equal_range(end(way.back()));
        while (at != last && !are_on_line_(first, second, end(at->second))) ++at;
        if (at == last) break;
        way.push_back(at->second);
        open.erase(at);
      }
      if (end(way.back()) != first) continue;
      for (const HalfEdge& edge : way) {
        for (const HalfEdge& other : way) {
          if (divided.contains(edge.triangle) || !is_within(start(other), edge)) continue;
          divided.insert(edge.triangle);
          divide(edge, start(other), 0);
        }
      }
    }
    return !divided.empty();
  }

  /// Returns whether a point on the edge's line lies between its ends.
  bool is_within(uint32_t point, const HalfEdge& edge) const {
    const Vec3 low = mesh_.vertices[edge.low];
    const Vec3 high = mesh_.vertices[edge.high];
    const Vec3 at = mesh_.vertices[point];
    return point != edge.low && point != edge.high && glm::dot(at - low, high - low) > 0 &&
           glm::dot(at - high, low - high) > 0;
  }

  /// The edges run in opposite directions.
  static void join(DisjointSets& fans, const HalfEdge& a, const HalfEdge& b) {
    fans.join(corner_of(a, 0), corner_of(b, 1));
    fans.join(corner_of(a, 1), corner_of(b, 0));
  }

  /// Joins triangles around one edge that bound the same part of the solid. Around the edge from
  /// low to high, counterclockwise, the solid begins at a triangle that passes it from high to low,
  /// and ends at one that passes it from low to high.
  void join_around(std::span<const HalfEdge> edges, DisjointSets& fans) {
    const Vec3 low = mesh_.vertices[edges.front().low];
    const Vec3 along = glm::normalize(mesh_.vertices[edges.front().high] - low);
    const auto across = [&](const HalfEdge& edge) {
      const Vec3 to_apex = mesh_.vertices[vertex(edge.triangle, edge.corner + 2)] - low;
      return to_apex - glm::dot(to_apex, along) * along;
    };
    const Vec3 zero = glm::normalize(across(edges.front()));
    const Vec3 quarter = glm::cross(along, zero);
    struct Turned {
      double angle;
      HalfEdge edge;
    };
    std::vector<Turned> turned;
    for (const HalfEdge& edge : edges) {
      const Vec3 direction = across(edge);
      turned.push_back({std::atan2(glm::dot(direction, quarter), glm::dot(direction, zero)), edge});
    }
    std::ranges::stable_sort(turned, {}, &Turned::angle);
    // Parts of the solid do not overlap: each ends where the next triangle rises. Of faces whose
    // directions rounding has exchanged the first that are left make a pair.
    std::vector<HalfEdge> begins;
    std::vector<HalfEdge> ends;
    for (size_t i = 0; i < turned.size(); ++i) {
      const HalfEdge& edge = turned[i].edge;
      const HalfEdge& next = turned[(i + 1) % turned.size()].edge;
      const HalfEdge& before = turned[(i + turned.size() - 1) % turned.size()].edge;
      if (!is_rising(edge) && is_rising(next)) {
        pair(fans, edge, next);
      } else if (!is_rising(edge)) {
        begins.push_back(edge);
      } else if (is_rising(before)) {
        ends.push_back(edge);
      }
    }
    for (size_t i = 0; i < std::min(begins.size(), ends.size()); ++i) {
      pair(fans, begins[i], ends[i]);
    }
  }

  void pair(DisjointSets& fans, const HalfEdge& begin, const HalfEdge& end) {
    join(fans, begin, end);
    crowded_.push_back({begin, end});
  }

  void copy_vertices(DisjointSets& fans) {
    std::vector<uint32_t> fan_of(mesh_.vertices.size(), kNoPlace);  // the one that keeps the vertex
    std::vector<uint32_t> copy_of(3 * place_of_.size(), kNoPlace);  // by fan
    for (uint32_t i = 0; i < place_of_.size(); ++i) {
      for (uint32_t j = 0; j < 3; ++j) {
        uint32_t& corner = mesh_.triangles[place_of_[i]][j];
        if (!may_touch_[corner]) continue;
        const uint32_t fan = fans.find(3 * i + j);
        if (fan_of[corner] == kNoPlace) fan_of[corner] = fan;
        if (fan_of[corner] == fan) continue;
        if (copy_of[fan] == kNoPlace) {
          copy_of[fan] = static_cast<uint32_t>(mesh_.vertices.size());
          mesh_.vertices.push_back(Vec3(mesh_.vertices[corner]));
        }
        corner = copy_of[fan];
      }
    }
  }

  /// Edges that still have four triangles get a vertex for each two beyond the first.
  void divide_edges() {
    std::set<std::array<uint32_t, 2>> known;
    for (size_t i = 0; i < crowded_.size(); ++i) {
      const HalfEdge falling = crowded_[i][0];
      const HalfEdge rising = crowded_[i][1];
      const std::array<uint32_t, 2> ends{vertex(rising.triangle, rising.corner),
                                         vertex(rising.triangle, rising.corner + 1)};
      if (known.insert(ends).second) continue;
      const auto middle = static_cast<uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back((mesh_.vertices[ends[0]] + mesh_.vertices[ends[1]]) / 2.0);
      divide(rising, middle, i + 1);
      divide(falling, middle, i + 1);
    }
  }

  /// Makes two triangles of one. Edges from `next` on that are in the second half move there.
  void divide(const HalfEdge& edge, uint32_t middle, size_t next) {
    auto& triangle = mesh_.triangles[place_of_[edge.triangle]];
    const size_t from = edge.corner;
    const size_t to = (from + 1) % 3;
    auto half = triangle;
    half[from] = middle;
    triangle[to] = middle;
    const auto number = static_cast<uint32_t>(place_of_.size());
    for (size_t i = next; i < crowded_.size(); ++i) {
      for (HalfEdge& other : crowded_[i]) {
        if (other.triangle == edge.triangle && other.corner == to) other.triangle = number;
      }
    }
    place_of_.push_back(static_cast<uint32_t>(mesh_.triangles.size()));
    mesh_.operands.push_back(uint32_t{mesh_.operands[place_of_[edge.triangle]]});
    mesh_.triangles.push_back(half);
  }

  BoundaryMesh& mesh_;
  const std::vector<bool>& may_touch_;
  const AreOnLine& are_on_line_;
  std::vector<uint32_t> place_of_;                // triangles of the mesh that have such a vertex
  std::vector<std::array<HalfEdge, 2>> crowded_;  // of edges with more than two triangles
};

}  // namespace

void make_manifold(BoundaryMesh& mesh, const std::vector<bool>& may_touch,
                   const AreOnLine& are_on_line) {
  Parting(mesh, may_touch, are_on_line).run();
}

}  // namespace csgcore
