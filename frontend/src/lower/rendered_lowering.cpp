#include "lower/rendered_lowering.hpp"

#include <algorithm>
#include <utility>

#include "lower/faceted_box.hpp"
#include "lower/render_text.hpp"
#include "plane/outlines.hpp"

namespace frontend {

LoweredSubtree lower_rendered_solid(const RingedFaces& faces, const csgcore::Affine& to_world,
                                    uint32_t frame, uint32_t id, PolyhedronPool& polyhedra) {
  LoweredSubtree result;
  FaceSet set = face_set_of(faces);
  for (csgcore::Vec3& point : set.points) point /= kRenderScale;
  uint64_t unfinite_faces = 0;  // none: the points are finite
  const SolidOfFaces& solid = polyhedra.solid(std::move(set), unfinite_faces);
  if (solid.is_empty()) return result;
  csgcore::Primitive primitive = solid.under(to_world);
  primitive.id = id;
  const csgcore::Box box = faceted_box(primitive, {});
  result.parts.push_back({std::move(primitive), frame, box});
  csgcore::CsgTreeBuilder builder;
  builder.primitive(0);
  result.solid = builder.finish();
  return result;
}

std::optional<Figure> rendered_figure(const RingedFaces& faces) {
  const auto is_at_bottom = [&](uint32_t corner) { return faces.points[corner].z == 0; };
  Polygons polygons;
  for (size_t i = 0; i < faces.ring_ends.size(); ++i) {
    const std::span<const uint32_t> ring = faces.ring(i);
    if (!std::ranges::all_of(ring, is_at_bottom)) continue;
    Polygon& polygon = polygons.emplace_back();
    for (const uint32_t corner : ring) polygon.emplace_back(faces.points[corner]);
  }
  return cleaned(outline_of(std::move(polygons)));
}

}  // namespace frontend
