#include "frontend/overlays.hpp"

#include <optional>

#include "picture/edge_overlay.hpp"
#include "picture/overlay_lines.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// Draws the crosshairs, which stay in the middle of the picture, whatever the camera looks at.
void draw_crosshairs(LinePainter& painter, const Camera& camera) {
  const double reach = camera.distance / 8;
  for (const double x : {-reach, reach}) {
    for (const double y : {-reach, reach}) {
      const Vec3 corner(x, y, reach);
      painter.draw(camera.target - corner, camera.target + corner);
    }
  }
}

}  // namespace

void draw_overlays(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                   const Overlays& overlays, const ColorScheme& scheme,
                   const ImportedDesign& design) {
  Canvas canvas(image, scheme.crosshair);
  if (!sees_nothing(camera, view.projection)) {
    if (overlays.grid) {
      draw_ground_grid(image, view, camera, scheme, overlays.grid_line_px);
    }
    if (overlays.edges) {
      const MeshLookup meshes(design);
      std::optional<ContrastLines> contrast;
      if (overlays.edge_color == EdgeColor::kContrast) contrast.emplace(image);
      const ContrastLines* const colors = contrast ? &*contrast : nullptr;
      draw_edges(image, view, scheme, meshes, colors);
      draw_facet_edges(image, view, camera, scheme, meshes, colors);
    }
    LinePainter painter(canvas, view, camera);
    if (overlays.crosshairs) draw_crosshairs(painter, camera);
    canvas.set_color(scheme.axes);
    if (overlays.axes) draw_axes(painter, design.axes_reach * camera.distance);
    if (overlays.axes && overlays.scales) draw_scale_marks(painter, camera);
  }
  if (overlays.axes && overlays.has_gnomon) draw_gnomon(canvas, view, scheme.axes);
}

}  // namespace frontend
