#include "nef_polytope.hpp"

#include <CGAL/Convex_hull_3/dual/halfspace_intersection_interior_point_3.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace oracle {
namespace {

using csgcore::TriangleMesh;
using Triangle = TriangleMesh::Triangle;
using Hull = CGAL::Polyhedron_3<Kernel>;

[[noreturn]] void throw_no_solid() {
  throw std::invalid_argument("the half-spaces of a polyhedron bound no solid");
}

/// Returns the pole p of the plane p·x = 1, by polarity about the origin. Poles of poles are the
/// planes again.
Point pole_of(const Plane& plane) {
  return {-plane.a() / plane.d(), -plane.b() / plane.d(), -plane.c() / plane.d()};
}

/// Returns a point of doubles in the interior. A linear program takes time in proportion to the
/// square of the number of planes. So it gets some of them first, and then those that its solution
/// violates.
Point interior_point(const std::vector<Plane>& planes) {
  constexpr std::size_t kFirstPlanes = 64;
  std::vector<Plane> some;
  for (std::size_t i = 0; i < planes.size(); i += planes.size() / kFirstPlanes + 1) {
    some.push_back(planes[i]);
  }
  for (;;) {
    const auto point = CGAL::halfspace_intersection_interior_point_3(some.begin(), some.end());
    const bool has_all = some.size() >= planes.size();
    if (!point && has_all) throw_no_solid();
    if (!point) {  // some of the planes bound no solid
      some = planes;
      continue;
    }
    const auto excess = [&](const Plane& plane) {
      return plane.orthogonal_vector() * (*point - CGAL::ORIGIN) + plane.d();
    };
    const auto worst =
        std::max_element(planes.begin(), planes.end(),
                         [&](const Plane& a, const Plane& b) { return excess(a) < excess(b); });
    if (excess(*worst) < 0) return *point;
    if (has_all) throw_no_solid();
    some.push_back(*worst);
  }
}

/// Returns an interior point in world coordinates.
Point interior_point(const FacetedSolid& polyhedron) {
  std::vector<Plane> planes;
  for (const csgcore::HalfSpace& h : polyhedron.half_spaces) {
    planes.emplace_back(h.normal.x, h.normal.y, h.normal.z, -h.offset);
  }
  if (planes.size() < 4) throw_no_solid();
  const Point local = interior_point(planes);
  const csgcore::Affine& map = polyhedron.local_to_world;
  return point_of(map.translation) + local.x() * vector_of(map.linear[0]) +
         local.y() * vector_of(map.linear[1]) + local.z() * vector_of(map.linear[2]);
}

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

Plane world_plane(const csgcore::HalfSpace& half_space, const csgcore::Affine& local_to_world) {
  // The half-space is n·M⁻¹·(x − t) ≤ o; multiplied by |det M|, it needs no quotients.
  const Vector x = vector_of(local_to_world.linear[0]);
  const Vector y = vector_of(local_to_world.linear[1]);
  const Vector z = vector_of(local_to_world.linear[2]);
  const Number determinant = CGAL::determinant(x, y, z);
  const Vector scaled = half_space.normal.x * CGAL::cross_product(y, z) +
                        half_space.normal.y * CGAL::cross_product(z, x) +
                        half_space.normal.z * CGAL::cross_product(x, y);
  const Vector normal = determinant > 0 ? scaled : -scaled;
  const Number offset =
      CGAL::abs(determinant) * half_space.offset + normal * vector_of(local_to_world.translation);
  return {normal.x(), normal.y(), normal.z(), -offset};
}

// The convex hull of the planes' poles about an interior point is the polar of the solid: its
// vertices are the solid's facets, and its facets are the solid's vertices. If more than three
// planes meet in one vertex, the hull has several coplanar triangles, whose poles are the same
// point.
Polytope polytope_of(const FacetedSolid& polyhedron) {
  const Point inside = interior_point(polyhedron);
  const Vector to_inside = inside - CGAL::ORIGIN;
  std::vector<Point> poles;
  for (const csgcore::HalfSpace& half_space : polyhedron.half_spaces) {
    const Plane plane = world_plane(half_space, polyhedron.local_to_world);
    poles.push_back(pole_of(
        {plane.a(), plane.b(), plane.c(), plane.d() + plane.orthogonal_vector() * to_inside}));
  }
  Hull hull;
  CGAL::convex_hull_3(poles.begin(), poles.end(), hull);
  if (hull.size_of_facets() < 4 || !hull.is_closed()) throw_no_solid();

  Polytope result;
  std::map<Point, std::size_t> indices;
  std::map<Hull::Facet_const_handle, std::size_t> vertex_of;
  for (auto facet = hull.facets_begin(); facet != hull.facets_end(); ++facet) {
    const auto edge = facet->halfedge();
    const Plane plane(edge->vertex()->point(), edge->next()->vertex()->point(),
                      edge->next()->next()->vertex()->point());
    if (!(plane.d() < 0)) throw_no_solid();  // the origin is not inside the hull
    const Point vertex = pole_of(plane) + to_inside;
    const auto [entry, is_new] = indices.try_emplace(vertex, result.vertices.size());
    if (is_new) result.vertices.push_back(vertex);
    vertex_of[facet] = entry->second;
  }
  for (auto vertex = hull.vertices_begin(); vertex != hull.vertices_end(); ++vertex) {
    std::vector<std::size_t> facet;
    auto edge = vertex->vertex_begin();
    const auto first = edge;
    do {
      const std::size_t corner = vertex_of.at(edge->facet());
      if (facet.empty() || facet.back() != corner) facet.push_back(corner);
    } while (++edge != first);
    while (facet.size() > 1 && facet.front() == facet.back()) facet.pop_back();
    std::reverse(facet.begin(), facet.end());  // a circulator runs clockwise
    if (facet.size() >= 3) result.facets.push_back(std::move(facet));
  }
  return result;
}

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
