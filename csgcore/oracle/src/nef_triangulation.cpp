#include "nef_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oracle {
namespace {

/// The number of borders between a triangle and the outside.
using Nesting = std::optional<int>;

using Traits = CGAL::Projection_traits_3<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Traits>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Traits, CGAL::Triangulation_face_base_with_info_2<Nesting, Traits>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Traits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

/// Returns the edges that cycles run along once, by their ends. An edge of the solid may lie within
/// a facet and end there, as the ridge of a groove does that reaches the facet from behind. A cycle
/// runs along such an edge in both directions, and the facet is on both of its sides.
std::set<std::pair<std::size_t, std::size_t>> borders_of(const Facet& facet) {
  std::set<std::pair<std::size_t, std::size_t>> borders;
  for (const std::vector<std::size_t>& cycle : facet.cycles) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const auto [a, b] = std::minmax(cycle[i], cycle[(i + 1) % cycle.size()]);
      const auto [border, is_new] = borders.emplace(a, b);
      if (!is_new) borders.erase(border);
    }
  }
  return borders;
}

/// Finds the nesting of all triangles, from the infinite face inwards.
void find_nesting(const Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.back()->info() = 0;
  for (std::size_t next = 0; next < open.size(); ++next) {
    const Triangulation::Face_handle face = open[next];
    for (int side = 0; side < 3; ++side) {
      const Triangulation::Face_handle neighbor = face->neighbor(side);
      if (neighbor->info()) continue;
      neighbor->info() = *face->info() + (face->is_constrained(side) ? 1 : 0);
      open.push_back(neighbor);
    }
  }
}

}  // namespace

void triangulate(const Facet& facet, const std::vector<Point>& points,
                 std::vector<std::array<std::size_t, 3>>& triangles) {
  Triangulation triangulation{Traits(facet.normal)};
  std::map<std::size_t, Triangulation::Vertex_handle> corners;
  for (const std::vector<std::size_t>& cycle : facet.cycles) {
    for (const std::size_t index : cycle) {
      const auto [corner, is_new] = corners.try_emplace(index);
      if (!is_new) continue;
      corner->second = triangulation.insert(points[index]);
      corner->second->info() = index;
    }
  }
  for (const auto& [a, b] : borders_of(facet)) {
    triangulation.insert_constraint(corners.at(a), corners.at(b));
  }
  find_nesting(triangulation);
  for (const Triangulation::Face_handle face : triangulation.finite_face_handles()) {
    const bool is_within = *face->info() % 2 == 1;
    if (!is_within) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
}

}  // namespace oracle
