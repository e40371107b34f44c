#include "plane/flattened_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "meshes/planar_predicates.hpp"
#include "plane/closed_walks.hpp"
#include "plane/outlines.hpp"

namespace frontend {
namespace {

using csgcore::FillRule;
using csgcore::Vec3;

/// On which side of the plane its own vertices count: then no vertex lies in it, and the section is
/// that of what lies directly on the other side.
enum class InPlane : uint8_t { kAbove, kBelow };

/// The outline of a section. Its corners are where edges cross the plane.
class SectionOutline {
 public:
  SectionOutline(const TriangleSet& solid, InPlane in_plane) : solid_(solid), in_plane_(in_plane) {}

  Outline make() const {
    std::vector<Arc> arcs;
    for (const auto& triangle : solid_.triangles) add_segment(triangle, arcs);
    Polygons polygons;
    for (const std::vector<uint64_t>& walk : closed_walks(std::move(arcs))) {
      Polygon& polygon = polygons.emplace_back();
      for (const uint64_t edge : walk) {
        const Vec2 point = crossing(edge);
        if (polygon.empty() || polygon.back() != point) polygon.push_back(point);
      }
    }
    return outline_of(std::move(polygons), FillRule::kNonZero);
  }

 private:
  bool is_above(uint32_t vertex) const {
    const double z = solid_.vertices[vertex].z;
    return z > 0 || (z == 0 && in_plane_ == InPlane::kAbove);
  }

  /// An edge that crosses the plane, by its ends.
  static uint64_t number_of(uint32_t above, uint32_t below) {
    return uint64_t{above} << 32 | below;
  }

  /// With the solid on its left, the outline enters a triangle where the triangle's own edges go
  /// down.
  void add_segment(const std::array<uint32_t, 3>& triangle, std::vector<Arc>& arcs) const {
    Arc arc{};
    bool crosses = false;
    for (size_t i = 0; i < triangle.size(); ++i) {
      const uint32_t from = triangle[i], to = triangle[(i + 1) % triangle.size()];
      if (is_above(from) == is_above(to)) continue;
      crosses = true;
      if (is_above(from)) {
        arc.from = number_of(from, to);
      } else {
        arc.to = number_of(to, from);
      }
    }
    if (crosses) arcs.push_back(arc);
  }

  Vec2 crossing(uint64_t edge) const {
    const Vec3& above = solid_.vertices[edge >> 32];
    const Vec3& below = solid_.vertices[edge & 0xFFFFFFFFu];
    if (above.z == 0) return plan_of(above);
    if (below.z == 0) return plan_of(below);
    return plan_of(above) + above.z / (above.z - below.z) * (plan_of(below) - plan_of(above));
  }

  const TriangleSet& solid_;
  const InPlane in_plane_;
};

/// An edge of a triangle's image, by its vertices.
struct PlanEdge {
  uint32_t least, most;
  int direction;  // 1: from `least` to `most`; −1: the other way
};

void add_edges(const std::array<uint32_t, 3>& triangle, std::vector<PlanEdge>& edges) {
  for (size_t i = 0; i < triangle.size(); ++i) {
    const uint32_t from = triangle[i], to = triangle[(i + 1) % triangle.size()];
    edges.push_back(from < to ? PlanEdge{from, to, 1} : PlanEdge{to, from, -1});
  }
}

/// What is left of the edges after those that run in both directions: the boundary of all
/// triangles, which winds around each point as often as triangles lie over it.
std::vector<Arc> boundary_of(std::vector<PlanEdge> edges) {
  std::sort(edges.begin(), edges.end(), [](const PlanEdge& a, const PlanEdge& b) {
    return std::pair(a.least, a.most) < std::pair(b.least, b.most);
  });
  std::vector<Arc> arcs;
  for (size_t i = 0; i < edges.size();) {
    const PlanEdge& edge = edges[i];
    int sum = 0;
    while (i < edges.size() && edges[i].least == edge.least && edges[i].most == edge.most) {
      sum += edges[i++].direction;
    }
    for (; sum > 0; --sum) arcs.push_back({edge.least, edge.most});
    for (; sum < 0; ++sum) arcs.push_back({edge.most, edge.least});
  }
  return arcs;
}

using Triangles = std::span<const std::array<uint32_t, 3>>;

/// Returns the union of the triangles' images, which run counterclockwise.
std::optional<SimplePolygons> united_plan(const TriangleSet& solid, Triangles triangles) {
  std::vector<PlanEdge> edges;
  for (const std::array<uint32_t, 3>& triangle : triangles) add_edges(triangle, edges);
  Polygons polygons;
  for (const std::vector<uint64_t>& walk : closed_walks(boundary_of(std::move(edges)))) {
    Polygon& polygon = polygons.emplace_back();
    for (const uint64_t vertex : walk) polygon.push_back(plan_of(solid.vertices[vertex]));
  }
  const Figure figure = outline_of(std::move(polygons), FillRule::kNonZero);
  return united(std::span(&figure, 1));
}

/// Removes the holes and specks that rounding has left between triangles, which are thinner than
/// this share of the size.
void remove_cracks(SimplePolygons& polygons) {
  constexpr double kThinnest = 0x1p-24;
  const Rectangle box = bounds_of(polygons);
  const double thinnest = kThinnest * glm::length(box.max - box.min);
  std::erase_if(polygons, [&](const Polygon& polygon) {
    double length = 0;
    visit_edges(polygon, [&](const Vec2& a, const Vec2& b) { length += glm::length(b - a); });
    return std::abs(signed_area(polygon)) < thinnest * length;
  });
}

/// Returns a union of triangles without the spikes and slits that rounding has left along edges
/// that corners of other triangles are on.
SimplePolygons without_slits(SimplePolygons polygons) {
  constexpr double kRounding = 0x1p-26;  // some lines of the grid (outlines.hpp)
  const Rectangle box = bounds_of(polygons);
  const double slight = kRounding * glm::length(box.max - box.min);
  const auto without_rounding = [slight](SimplePolygons rounded) {
    remove_cracks(rounded);
    return without_slight_corners(std::move(rounded), slight);
  };
  polygons = without_rounding(std::move(polygons));
  // Polygons that a slit has divided along all of an edge have that edge in common now.
  std::optional<SimplePolygons> joined = combined(csgcore::Op::kUnion, std::span(&polygons, 1));
  return joined ? without_rounding(std::move(*joined)) : polygons;
}

/// Returns the same, for triangles of a rough solid: what lies over each other within a group of
/// neighbours is gone before groups are united.
std::optional<SimplePolygons> united_in_groups(const TriangleSet& solid, Triangles triangles) {
  constexpr size_t kGroup = 64;
  std::vector<SimplePolygons> groups;
  for (size_t first = 0; first < triangles.size(); first += kGroup) {
    const size_t count = std::min(kGroup, triangles.size() - first);
    std::optional<SimplePolygons> group = united_plan(solid, triangles.subspan(first, count));
    if (!group) return std::nullopt;
    groups.push_back(std::move(*group));
  }
  while (groups.size() > 1) {
    std::vector<SimplePolygons> larger;
    for (size_t i = 0; i + 1 < groups.size(); i += 2) {
      std::optional<SimplePolygons> both =
          combined(csgcore::Op::kUnion, std::span(groups).subspan(i, 2));
      if (!both) return std::nullopt;
      remove_cracks(*both);
      larger.push_back(std::move(*both));
    }
    if (groups.size() % 2 != 0) larger.push_back(std::move(groups.back()));
    groups = std::move(larger);
  }
  return groups.empty() ? SimplePolygons{} : std::move(groups.front());
}

}  // namespace

std::vector<Figure> section_of(const TriangleSet& solid) {
  const bool touches = std::any_of(solid.vertices.begin(), solid.vertices.end(),
                                   [](const Vec3& vertex) { return vertex.z == 0; });
  Outline below = SectionOutline(solid, InPlane::kAbove).make();
  if (!touches) {
    std::optional<Figure> figure = cleaned(std::move(below));
    return figure ? std::vector<Figure>{std::move(*figure)} : std::vector<Figure>{};
  }
  std::vector<Figure> both{std::move(below), SectionOutline(solid, InPlane::kBelow).make()};
  std::optional<SimplePolygons> polygons = united(both);
  if (!polygons) return both;
  if (polygons->empty()) return {};
  return {outline_of(std::move(*polygons))};
}

std::optional<Figure> shadow_of(const TriangleSet& solid, Boundary boundary) {
  std::vector<std::array<uint32_t, 3>> triangles;  // all of them counterclockwise in the plan
  for (std::array<uint32_t, 3> triangle : solid.triangles) {
    const int turn =
        orientation(plan_of(solid.vertices[triangle[0]]), plan_of(solid.vertices[triangle[1]]),
                    plan_of(solid.vertices[triangle[2]]));
    // A closed boundary casts the shadow of its upper faces.
    if (turn == 0 || (turn < 0 && boundary == Boundary::kClosed)) continue;
    if (turn < 0) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  std::optional<SimplePolygons> polygons = united_plan(solid, triangles);
  if (!polygons) polygons = united_in_groups(solid, triangles);
  if (!polygons) return std::nullopt;
  return outline_of(without_slits(std::move(*polygons)));
}

}  // namespace frontend
