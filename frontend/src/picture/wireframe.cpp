#include "frontend/wireframe.hpp"

#include <cmath>
#include <vector>

#include "picture/overlay_lines.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::View;

// OpenSCAD's sizes, which do not depend on the picture's.
constexpr int64_t kHalfLine_px = 2;  // beside the middle pixel, across the larger of dx and dy
constexpr double kHalfVertex_px = 5;
// OpenSCAD's colours of vertices are the same in all schemes.
constexpr Rgb kVertex{0xff, 0xf6, 0x7c};
constexpr Rgb kCutVertex{0xb7, 0xe8, 0x5c};

class WirePainter {
 public:
  WirePainter(Image& image, const View& view, const Camera& camera)
      : canvas_(image, {}),
        projector_(view, camera),
        z_(image.z.begin(), image.z.end()),
        tolerance_(kCoincidence * std::abs(camera.distance)) {}

  void draw_vertex(const csgcore::Vec3& position, Rgb color) {
    const auto ends = projector_.line(position, position);
    if (!ends) return;
    canvas_.set_color(color);
    const ScreenPoint& at = ends->front();
    const auto first = [](double middle) { return std::ceil(middle - kHalfVertex_px - 0.5); };
    for (double y = first(at.y); y + 0.5 < at.y + kHalfVertex_px; ++y) {
      for (double x = first(at.x); x + 0.5 < at.x + kHalfVertex_px; ++x) {
        if (!(std::abs(x) < kFarthest_px && std::abs(y) < kFarthest_px)) return;
        draw_pixel(static_cast<int64_t>(x), static_cast<int64_t>(y), projector_.s_of(at.depth));
      }
    }
  }

  void draw_edge(const csgcore::Vec3& from, const csgcore::Vec3& to, Rgb color) {
    const auto ends = projector_.line(from, to);
    if (!ends) return;
    canvas_.set_color(color);
    const auto& [a, b] = *ends;
    const bool along_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    walk_line(canvas_, a, b, [&](int64_t column, int64_t row, double depth, double) {
      const double s = projector_.s_of(depth);
      for (int64_t i = -kHalfLine_px; i <= kHalfLine_px; ++i) {
        draw_pixel(along_x ? column : column + i, along_x ? row + i : row, s);
      }
    });
  }

 private:
  static constexpr double kFarthest_px = 1e9;

  void draw_pixel(int64_t column, int64_t row, double s) {
    if (!canvas_.contains(column, row)) return;
    double& z = z_[static_cast<std::size_t>(row * canvas_.width() + column)];
    if (s > z + tolerance_) return;
    z = std::min(z, s);
    canvas_.draw(column, row);
  }

  Canvas canvas_;
  Projector projector_;
  std::vector<double> z_;  // of what is drawn so far
  double tolerance_;
};

}  // namespace

void draw_wireframe(Image& image, const View& view, const Camera& camera, const SolidEdges& edges,
                    const ColorScheme& scheme) {
  if (sees_nothing(camera, view.projection)) return;
  WirePainter painter(image, view, camera);
  for (const SolidEdges::Vertex& vertex : edges.vertices) {
    painter.draw_vertex(vertex.position, vertex.is_cut ? kCutVertex : kVertex);
  }
  for (const SolidEdges::Edge& edge : edges.edges) {
    painter.draw_edge(edge.from, edge.to, edge.is_cut ? scheme.cut_edge : scheme.edge);
  }
}

}  // namespace frontend
