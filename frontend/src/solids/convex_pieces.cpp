#include "solids/convex_pieces.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
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

/// Triangles of what is cut, over all cuts: so many take about two seconds.
constexpr size_t kMostCutTriangles = size_t{1} << 18;
/// Surfaces of more edges that turn inwards are curved, and never end in few pieces.
constexpr size_t kMostReflexEdges = 250;

csgcore::CsgTree tree_of_two(Op op) {
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  return builder.finish();
}

/// The longest edge at which the solid turns inwards; null: it does at none.
const SurfaceEdge* longest_reflex(const TriangleSet& surface, const std::vector<SurfaceEdge>& edges,
                                  double slack) {
  const SurfaceEdge* best = nullptr;
  double most = 0;
  for (const SurfaceEdge& edge : edges) {
    if (!edge.is_reflex(slack)) continue;
    const double length = glm::length(surface.vertices[edge.to] - surface.vertices[edge.from]);
    if (best != nullptr && length <= most) continue;
    best = &edge;
    most = length;
  }
  return best;
}

Vec3 area_of(const TriangleSet& surface, uint32_t triangle) {
  const auto& t = surface.triangles[triangle];
  const Vec3& corner = surface.vertices[t[0]];
  return glm::cross(surface.vertices[t[1]] - corner, surface.vertices[t[2]] - corner);
}

/// What of the box around the surface, and more, lies below the plane of the larger triangle at the
/// edge. It is so far above the plane that the face as a whole lies below.
TriangleSet half_at(const TriangleSet& surface, const SurfaceEdge& edge, double slack) {
  csgcore::Box box;
  for (const Vec3& vertex : surface.vertices) box.merge(vertex);
  const Vec3 left = area_of(surface, edge.left), right = area_of(surface, edge.right);
  const Vec3 normal = glm::normalize(glm::length(left) >= glm::length(right) ? left : right);
  constexpr double kShareOfSlack = 0.25;
  const csgcore::HalfSpace half{
      normal, glm::dot(normal, surface.vertices[edge.from]) + kShareOfSlack * slack};
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

}  // namespace

size_t count_of_reflex_edges(const TriangleSet& surface) {
  const double slack = slack_of(surface);
  return static_cast<size_t>(std::ranges::count_if(
      edges_of(surface), [slack](const SurfaceEdge& edge) { return edge.is_reflex(slack); }));
}

std::optional<std::vector<PiecePoints>> convex_pieces(TriangleSet surface, SolidPool& pool) {
  if (count_of_reflex_edges(surface) > kMostReflexEdges) return std::nullopt;
  const double slack = slack_of(surface);
  std::vector<PiecePoints> result;
  std::vector<TriangleSet> todo;
  todo.push_back(std::move(surface));
  size_t work = 0;
  while (!todo.empty()) {
    csgcore::stop_point();
    TriangleSet solid = std::move(todo.back());
    todo.pop_back();
    join_vertices(solid);
    if (solid.triangles.empty()) continue;
    const std::vector<SurfaceEdge> edges = edges_of(solid);
    const SurfaceEdge* const longest = longest_reflex(solid, edges, slack);
    if (longest == nullptr) {
      for (PiecePoints& points : points_by_piece(solid, edges)) result.push_back(std::move(points));
      continue;
    }
    work += solid.triangles.size();
    if (work > kMostCutTriangles) return std::nullopt;
    const std::array<TriangleSet, 2> operands{solid, half_at(solid, *longest, slack)};
    for (const Op op : {Op::kDifference, Op::kIntersection}) {
      todo.push_back(pool.boundary(operands, tree_of_two(op)));
    }
  }
  return result;
}

}  // namespace frontend
