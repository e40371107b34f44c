#include "solids/convex_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "csgcore/csg_tree.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/stop_scope.hpp"
#include "hulls/point_solid.hpp"
#include "solids/surface_edges.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;

/// Surfaces of more edges that turn inwards are curved, and never end in few pieces.
constexpr size_t kMostReflexEdges = 250;

/// What is still to be cut.
struct Part {
  TriangleSet solid;
  /// It turns inwards at fewer edges than this: each cut ends at least one, and where it ends none
  /// the plane of a narrow face was rounded too far, and more cuts only make more slivers.
  size_t limit;
};

csgcore::CsgTree tree_of_two(Op op) {
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  return builder.finish();
}

Vec3 area_of(const TriangleSet& surface, uint32_t triangle) {
  const auto& t = surface.triangles[triangle];
  const Vec3& corner = surface.vertices[t[0]];
  return glm::cross(surface.vertices[t[1]] - corner, surface.vertices[t[2]] - corner);
}

/// The half space below the plane of the larger triangle at the edge. It is so far above the plane
/// that the face as a whole lies below.
csgcore::HalfSpace half_at(const TriangleSet& surface, const SurfaceEdge& edge, double slack) {
  const Vec3 left = area_of(surface, edge.left), right = area_of(surface, edge.right);
  const Vec3 normal = glm::normalize(glm::length(left) >= glm::length(right) ? left : right);
  constexpr double kShareOfSlack = 0.25;
  return {normal, glm::dot(normal, surface.vertices[edge.from]) + kShareOfSlack * slack};
}

using Edges = std::vector<const SurfaceEdge*>;

/// The edges at which the solid turns inwards, and that are longer than the slack: cuts leave
/// shorter ones at corners.
Edges reflex_edges(const TriangleSet& surface, const std::vector<SurfaceEdge>& edges,
                   double slack) {
  Edges reflex;
  for (const SurfaceEdge& edge : edges) {
    const Vec3 along = surface.vertices[edge.to] - surface.vertices[edge.from];
    if (edge.is_reflex(slack) && glm::length(along) > slack) reflex.push_back(&edge);
  }
  return reflex;
}

/// Returns that one of the half spaces at these edges which leaves fewest of them on the side that
/// has more of them.
csgcore::HalfSpace best_cut(const TriangleSet& surface, const Edges& reflex, double slack) {
  csgcore::HalfSpace best{};
  size_t fewest = reflex.size() + 1;
  for (const SurfaceEdge* const edge : reflex) {
    const csgcore::HalfSpace half = half_at(surface, *edge, slack);
    size_t below = 0, above = 0;
    for (const SurfaceEdge* const other : reflex) {
      const double from = glm::dot(half.normal, surface.vertices[other->from]) - half.offset;
      const double to = glm::dot(half.normal, surface.vertices[other->to]) - half.offset;
      below += std::min(from, to) < -slack;
      above += std::max(from, to) > slack;
    }
    if (std::max(below, above) >= fewest) continue;
    fewest = std::max(below, above);
    best = half;
  }
  return best;
}

/// What of the box around the surface, and more, lies in the half space.
TriangleSet cut_box(const TriangleSet& surface, const csgcore::HalfSpace& half, double slack) {
  csgcore::Box box;
  for (const Vec3& vertex : surface.vertices) box.merge(vertex);
  const Vec3 margin = 0.25 * box.size() + Vec3(slack);
  Corners corners;
  for (const double x : {box.min.x - margin.x, box.max.x + margin.x}) {
    for (const double y : {box.min.y - margin.y, box.max.y + margin.y}) {
      for (const double z : {box.min.z - margin.z, box.max.z + margin.z}) {
        corners.emplace_back(x, y, z);
      }
    }
  }
  return triangles_of_hull(cut(corners, half));
}

/// The points of the surface's connected pieces.
std::vector<PiecePoints> points_by_piece(const TriangleSet& surface,
                                         const std::vector<SurfaceEdge>& edges) {
  const std::vector<uint32_t> piece = pieces_of(surface, edges);
  std::vector<PiecePoints> result;
  constexpr uint32_t kNowhere = 0xFFFFFFFFu;
  std::vector<uint32_t> at(surface.vertices.size(), kNowhere);  // the last piece that has it
  for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (piece[t] >= result.size()) result.resize(piece[t] + 1);
    for (const uint32_t vertex : surface.triangles[t]) {
      if (at[vertex] == piece[t]) continue;
      at[vertex] = piece[t];
      result[piece[t]].push_back(surface.vertices[vertex]);
    }
  }
  return result;
}

double volume_of(const TriangleSet& surface) {
  double sum = 0;
  if (surface.vertices.empty()) return 0;
  const Vec3& origin = surface.vertices.front();  // of what is far from the world's, too
  for (const auto& t : surface.triangles) {
    sum += glm::dot(surface.vertices[t[0]] - origin,
                    glm::cross(surface.vertices[t[1]] - origin, surface.vertices[t[2]] - origin));
  }
  return sum / 6;
}

}  // namespace

size_t count_of_reflex_edges(const TriangleSet& surface) {
  const double slack = slack_of(surface);
  return static_cast<size_t>(std::ranges::count_if(
      edges_of(surface), [slack](const SurfaceEdge& edge) { return edge.is_reflex(slack); }));
}

std::optional<std::vector<PiecePoints>> convex_pieces(TriangleSet surface, SolidPool& pool,
                                                      size_t most_cut_triangles) {
  if (count_of_reflex_edges(surface) > kMostReflexEdges) return std::nullopt;
  const double slack = slack_of(surface);
  std::vector<PiecePoints> result;
  std::vector<Part> todo;
  todo.push_back({std::move(surface), std::numeric_limits<size_t>::max()});
  size_t work = 0;
  while (!todo.empty()) {
    csgcore::stop_point();
    auto [solid, limit] = std::move(todo.back());
    todo.pop_back();
    join_vertices(solid);
    if (solid.triangles.empty()) continue;
    const std::vector<SurfaceEdge> edges = edges_of(solid);
    const Edges reflex = reflex_edges(solid, edges, slack);
    if (reflex.empty()) {
      for (PiecePoints& points : points_by_piece(solid, edges)) result.push_back(std::move(points));
      continue;
    }
    work += solid.triangles.size();
    if (reflex.size() >= limit || work > most_cut_triangles) return std::nullopt;
    const std::array<TriangleSet, 2> operands{
        solid, cut_box(solid, best_cut(solid, reflex, slack), slack)};
    for (const Op op : {Op::kDifference, Op::kIntersection}) {
      todo.push_back({pool.boundary(operands, tree_of_two(op)), reflex.size()});
    }
  }
  return result;
}

bool fill(const std::vector<PiecePoints>& pieces, const TriangleSet& surface) {
  double excess = -volume_of(surface), area = 0;
  for (const PiecePoints& points : pieces) {
    excess += volume_of(triangles_of_hull({points.begin(), points.end()}));
  }
  for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
    area += 0.5 * glm::length(area_of(surface, t));
  }
  return std::abs(excess) <= slack_of(surface) * area;
}

}  // namespace frontend
