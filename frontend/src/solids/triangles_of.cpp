#include "solids/triangles_of.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/point_hull.hpp"
#include "plane/outlines.hpp"
#include "solids/revolved_solid.hpp"
#include "solids/sliced_solid.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;

/// The faces are convex.
TriangleSet triangles_of(csgcore::Mesh mesh) {
  TriangleSet result{std::move(mesh.vertices), {}};
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      result.triangles.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return result;
}

TriangleSet triangles_of(const csgcore::TriangleMesh& mesh) {
  return {{mesh.vertices().begin(), mesh.vertices().end()},
          {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// Nothing is left of a profile whose edges cross too often.
SimplePolygons polygons_of(const csgcore::Profile& profile) {
  const Figure figure =
      Outline{{profile.loops().begin(), profile.loops().end()}, profile.fill_rule()};
  return united(std::span(&figure, 1)).value_or(SimplePolygons{});
}

template <class RoundShape>
TriangleSet triangles_of(const RoundShape& shape) {
  return triangles_of(csgcore::faceted_mesh({shape, {}}, kChordsOfCircle));
}

TriangleSet triangles_of(const csgcore::PolyhedronShape& shape) {
  const std::vector<Vec3>& vertices = shape.polyhedron->vertices();
  return {vertices, point_hull(on_grid(vertices)).triangles};
}

TriangleSet triangles_of(const csgcore::MeshShape& shape) { return triangles_of(*shape.mesh); }

TriangleSet triangles_of(const csgcore::ExtrusionShape& extrusion) {
  SimplePolygons polygons = polygons_of(*extrusion.profile);
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) point *= extrusion.scale_bottom;
  }
  const TwistedLayers layers{extrusion.z_min, extrusion.z_max, 0,
                             Vec2(extrusion.scale_top / extrusion.scale_bottom)};
  Slicing slicing{1, std::move(polygons), {}};
  slicing.offsets.resize(slicing.outline.size());
  return triangles_of(*sliced_mesh(layers, slicing).mesh());
}

TriangleSet triangles_of(const csgcore::RevolutionShape& revolution) {
  TurnSections sections;
  sections.count = kChordsOfCircle;
  return triangles_of(*revolved_mesh(polygons_of(*revolution.profile), sections).mesh());
}

}  // namespace

TriangleSet triangles_of(const Primitive& primitive) {
  TriangleSet result =
      std::visit([](const auto& shape) { return triangles_of(shape); }, primitive.solid);
  csgcore::Box box;
  for (Vec3& vertex : result.vertices) {
    vertex = primitive.local_to_world.point(vertex);
    box.merge(vertex);
  }
  const double size = box.empty() ? 0 : box.diagonal();
  for (Vec3& vertex : result.vertices) {
    if (is_in_plane(vertex.z, size)) vertex.z = 0;
  }
  return result;
}

bool is_in_plane(double z, double size) {
  // Solids that are smaller than a unit, which OpenSCAD's grid is too coarse for, have a finer one.
  constexpr double kGrid = 0x1p-20;
  return std::abs(z) < kGrid * std::min(size, 1.0);
}

}  // namespace frontend
