#include "solids/roof_solid.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/triangle_mesh.hpp"
#include "meshes/triangulation.hpp"

namespace frontend {

csgcore::Primitive roof_mesh(const Roof& roof) {
  std::vector<csgcore::TriangleMesh::Triangle> triangles;
  const auto places_of = [&](std::span<const uint32_t> corners) {
    std::vector<Vec2> places;
    for (const uint32_t corner : corners) places.push_back(plan_of(roof.points[corner]));
    return places;
  };
  uint32_t begin = 0;
  for (const uint32_t end : roof.ends) {
    const std::span<const uint32_t> face(roof.corners.data() + begin, end - begin);
    triangulate(face, places_of(face), triangles);
    begin = end;
  }
  triangulate_all_reversed(roof.outline, roof.outline_ends, places_of(roof.outline), triangles);
  return csgcore::make_mesh(
      std::make_shared<csgcore::TriangleMesh>(roof.points, std::move(triangles)));
}

}  // namespace frontend
