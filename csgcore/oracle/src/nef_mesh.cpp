#include "nef_mesh.hpp"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace oracle {
namespace {

using csgcore::TriangleMesh;
using Triangle = TriangleMesh::Triangle;

std::vector<Point> world_vertices(const FacetedSolid& solid) {
  const csgcore::Affine& map = solid.local_to_world;
  std::vector<Point> vertices;
  for (const csgcore::Vec3& v : solid.mesh->vertices()) {
    vertices.push_back(point_of(map.translation) + Number(v.x) * vector_of(map.linear[0]) +
                       Number(v.y) * vector_of(map.linear[1]) +
                       Number(v.z) * vector_of(map.linear[2]));
  }
  return vertices;
}

/// Returns the triangle beyond each edge of each triangle.
std::vector<std::array<uint32_t, 3>> neighbours_of(std::span<const Triangle> triangles) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> owner;  // by directed edge
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const std::pair edge(triangles[i][k], triangles[i][(k + 1) % 3]);
      if (!owner.try_emplace(edge, i).second) {
        throw std::invalid_argument("more than two triangles of a mesh share an edge");
      }
    }
  }
  std::vector<std::array<uint32_t, 3>> neighbours(triangles.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const auto beyond = owner.find({triangles[i][(k + 1) % 3], triangles[i][k]});
      if (beyond == owner.end()) throw std::invalid_argument("a mesh is not closed");
      neighbours[i][k] = beyond->second;
    }
  }
  return neighbours;
}

/// Returns the triangles of each shell.
std::vector<std::vector<uint32_t>> connected_parts(std::span<const Triangle> triangles) {
  const std::vector<std::array<uint32_t, 3>> neighbours = neighbours_of(triangles);
  std::vector<bool> is_seen(triangles.size());
  std::vector<std::vector<uint32_t>> parts;
  for (uint32_t first = 0; first < triangles.size(); ++first) {
    if (is_seen[first]) continue;
    is_seen[first] = true;
    std::vector<uint32_t>& part = parts.emplace_back(1, first);
    for (size_t i = 0; i < part.size(); ++i) {
      for (const uint32_t neighbour : neighbours[part[i]]) {
        if (is_seen[neighbour]) continue;
        is_seen[neighbour] = true;
        part.push_back(neighbour);
      }
    }
  }
  return parts;
}

Polytope polytope_of(std::span<const Triangle> triangles, const std::vector<uint32_t>& part,
                     const std::vector<Point>& vertices) {
  Polytope polytope;
  std::map<uint32_t, size_t> indices;
  for (const uint32_t triangle : part) {
    std::vector<size_t>& facet = polytope.facets.emplace_back();
    for (const uint32_t vertex : triangles[triangle]) {
      const auto [entry, is_new] = indices.try_emplace(vertex, polytope.vertices.size());
      if (is_new) polytope.vertices.push_back(vertices[vertex]);
      facet.push_back(entry->second);
    }
    if (CGAL::collinear(vertices[triangles[triangle][0]], vertices[triangles[triangle][1]],
                        vertices[triangles[triangle][2]])) {
      throw std::invalid_argument("a triangle of a mesh has no area");
    }
  }
  return polytope;
}

bool intersects_itself(const Polytope& polytope) {
  CGAL::Surface_mesh<Point> mesh;
  std::vector<CGAL::Surface_mesh<Point>::Vertex_index> vertices;
  for (const Point& vertex : polytope.vertices) vertices.push_back(mesh.add_vertex(vertex));
  for (const auto& facet : polytope.facets) {
    mesh.add_face(vertices[facet[0]], vertices[facet[1]], vertices[facet[2]]);
  }
  // A face that cannot be added has a vertex that is no manifold's.
  return mesh.number_of_faces() < polytope.facets.size() ||
         CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
}

Number signed_volume(const Polytope& polytope) {
  const Point& origin = polytope.vertices.front();
  Number sum = 0;
  for (const auto& facet : polytope.facets) {
    sum += CGAL::determinant(polytope.vertices[facet[0]] - origin,
                             polytope.vertices[facet[1]] - origin,
                             polytope.vertices[facet[2]] - origin);
  }
  return sum;
}

}  // namespace

std::vector<MeshShell> shells_of(const FacetedSolid& solid) {
  const std::span<const Triangle> triangles = solid.mesh->triangles();
  const std::vector<Point> vertices = world_vertices(solid);
  std::vector<MeshShell> shells;
  for (const std::vector<uint32_t>& part : connected_parts(triangles)) {
    MeshShell shell{polytope_of(triangles, part, vertices)};
    if (intersects_itself(shell.polytope)) {
      throw std::invalid_argument("a shell of a mesh intersects itself");
    }
    shell.is_inward = signed_volume(shell.polytope) < 0;
    if (shell.is_inward) {
      for (auto& facet : shell.polytope.facets) std::swap(facet[1], facet[2]);
    }
    shells.push_back(std::move(shell));
  }
  return shells;
}

std::vector<Plane> triangle_planes(const FacetedSolid& solid) {
  const std::vector<Point> vertices = world_vertices(solid);
  std::vector<Plane> planes;
  for (const auto& [a, b, c] : solid.mesh->triangles()) {
    if (CGAL::collinear(vertices[a], vertices[b], vertices[c])) continue;
    planes.emplace_back(vertices[a], vertices[b], vertices[c]);
  }
  return planes;
}

}  // namespace oracle
