#include "picture/flat_figure.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "picture/overlay_lines.hpp"

namespace frontend {

using csgcore::Vec3;

void color_flat_figure(csgcore::Scene& scene, const csgcore::View& view,
                       const ColorScheme& scheme) {
  // OpenSCAD's light (frontend/OPENSCAD.md, "Light and colours").
  const Vec3 light = (-view.right + view.up - view.forward) / std::sqrt(3.0);
  const double shade = 255 * (0.2 + std::abs(light.z));
  const Rgb& face = scheme.flat_face;
  for (csgcore::Primitive& primitive : scene.primitives) {
    primitive.color =
        csgcore::Color{static_cast<float>(face.r / shade), static_cast<float>(face.g / shade),
                       static_cast<float>(face.b / shade), 1};
  }
}

void draw_flat_outlines(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                        const ImportedDesign& design, const ColorScheme& scheme) {
  Canvas canvas(image, scheme.flat_edge);
  const Projector projector(view, camera);
  for (const std::vector<Vec3>& outline : design.flat_outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const auto ends = projector.line(outline[i], outline[(i + 1) % outline.size()]);
      if (!ends) continue;
      const auto& [a, b] = *ends;
      const bool along_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
      walk_line(canvas, a, b, [&](int64_t column, int64_t row, double, double) {
        // The pixel above or to the left is the line's second one.
        canvas.draw(column, row);
        canvas.draw(along_x ? column : column - 1, along_x ? row - 1 : row);
      });
    }
  }
}

}  // namespace frontend
