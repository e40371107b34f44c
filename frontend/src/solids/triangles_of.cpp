#include "solids/triangles_of.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
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
using csgcore::TriangleSet;
using csgcore::Vec3;

/// The faces are convex, and so is the solid.
TriangleSet triangles_of(csgcore::Mesh mesh) {
  TriangleSet result{std::move(mesh.vertices), {}, true};
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
SimplePolygons polygons_of(const csgcore::Profile& profile, int chords) {
  const Figure figure =
      Outline{{profile.loops().begin(), profile.loops().end()}, profile.fill_rule()};
  // Other curves are as near to theirs as those of the largest circle within the figure.
  const Rectangle bounds = bounds_of(figure);
  const double radius = bounds.empty() ? 0 : glm::length(bounds.max - bounds.min) / 4;
  const Chords fineness{chords, (1 - std::cos(std::numbers::pi / chords)) * radius, chords};
  return united(std::span(&figure, 1), fineness).value_or(SimplePolygons{});
}

template <class RoundShape>
TriangleSet local_triangles(const RoundShape& shape, int chords) {
  return triangles_of(csgcore::faceted_mesh({shape, {}}, chords));
}

TriangleSet local_triangles(const csgcore::PolyhedronShape& shape, int) {
  return triangles_of_hull(shape.polyhedron->vertices());
}

TriangleSet local_triangles(const csgcore::MeshShape& shape, int) {
  return triangles_of(*shape.mesh);
}

TriangleSet local_triangles(const csgcore::ExtrusionShape& extrusion, int chords) {
  SimplePolygons polygons = polygons_of(*extrusion.profile, chords);
  const bool is_simple = polygons.size() == 1;
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) point *= extrusion.scale_bottom;
  }
  const TwistedLayers layers{extrusion.z_min, extrusion.z_max, 0,
                             Vec2(extrusion.scale_top / extrusion.scale_bottom)};
  Slicing slicing{1, std::move(polygons), {}};
  slicing.offsets.resize(slicing.outline.size());
  TriangleSet result = triangles_of(*sliced_mesh(layers, slicing).mesh());
  result.is_simple = is_simple && extrusion.scale_top > 0;
  return result;
}

TriangleSet local_triangles(const csgcore::RevolutionShape& revolution, int chords) {
  TurnSections sections;
  sections.count = chords;
  return triangles_of(*revolved_mesh(polygons_of(*revolution.profile, chords), sections).mesh());
}

}  // namespace

TriangleSet triangles_of(const Primitive& primitive, int chords) {
  TriangleSet result = std::visit(
      [chords](const auto& shape) { return local_triangles(shape, chords); }, primitive.solid);
  place(result, primitive.local_to_world);
  return result;
}

void place(TriangleSet& surface, const csgcore::Affine& local_to_world) {
  for (Vec3& vertex : surface.vertices) vertex = local_to_world.point(vertex);
  if (local_to_world.determinant() >= 0) return;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

TriangleSet triangles_of_hull(std::vector<Vec3> points) {
  PointHull hull = point_hull(on_grid(points));
  return {std::move(points), std::move(hull.triangles), true};
}

void put_in_plane(TriangleSet& solid) {
  csgcore::Box box;
  for (const Vec3& vertex : solid.vertices) box.merge(vertex);
  const double size = box.empty() ? 0 : box.diagonal();
  for (Vec3& vertex : solid.vertices) {
    if (is_in_plane(vertex.z, size)) vertex.z = 0;
  }
}

bool is_in_plane(double z, double size) {
  // Solids that are smaller than a unit, which OpenSCAD's grid is too coarse for, have a finer one.
  constexpr double kGrid = 0x1p-20;
  return std::abs(z) < kGrid * std::min(size, 1.0);
}

}  // namespace frontend
