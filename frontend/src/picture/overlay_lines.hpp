// Draws lines in space over a finished picture, where the model does not hide them: OpenSCAD's
// --view=axes and --view=scales.
#pragma once

#include <array>
#include <optional>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "picture/overlay_canvas.hpp"

namespace frontend {

/// A line that lies in a face, or meets a vertex, is drawn over it: z is a float, and a renderer's
/// may be off by a few ulp. In shares of the camera's distance.
inline constexpr double kCoincidence = 1e-5;

enum class LineStyle : uint8_t {
  kSolid,
  kStippled,  // 3 pixels off, 3 on, as in OpenSCAD
};

/// Brings lines in space to the screen.
class Projector {
 public:
  /// The view must outlive the projector. A perspective view clips at a tenth of the camera's
  /// distance, as OpenSCAD does.
  Projector(const csgcore::View& view, const Camera& camera);

  /// Returns the ends of a line in world space, clipped; nothing if nothing is left of it.
  std::optional<std::array<ScreenPoint, 2>> line(const csgcore::Vec3& from,
                                                 const csgcore::Vec3& to) const;
  /// Returns View's s of a depth on the screen.
  double s_of(double depth) const { return is_perspective_ ? 1 / depth : depth; }

 private:
  csgcore::Vec3 to_eye(const csgcore::Vec3& point) const;
  bool clip(csgcore::Vec3& point, const csgcore::Vec3& other) const;
  ScreenPoint to_screen(const csgcore::Vec3& point_eye) const;

  const csgcore::View& view_;
  double distance_;
  bool is_perspective_;
};

class LinePainter {
 public:
  /// The view, and the canvas, whose picture has its z channel, must outlive the painter.
  LinePainter(Canvas& canvas, const csgcore::View& view, const Camera& camera);

  /// Draws from `from` up to but without `to`, in world space, 1 px wide, where the model is not in
  /// front. A perspective view clips at a tenth of the camera's distance, as OpenSCAD does.
  void draw(const csgcore::Vec3& from, const csgcore::Vec3& to,
            LineStyle style = LineStyle::kSolid);

 private:
  Canvas& canvas_;
  Projector projector_;
  double distance_;
};

/// Draws the world's axes so far from the origin to both sides, the negative halves stippled.
void draw_axes(LinePainter& painter, double reach);

/// Draws the red, green and blue axes in the lower left corner, over everything.
void draw_gnomon(Canvas& canvas, const csgcore::View& view, Rgb label_color);

/// Draws a grid of grid_spacing(), with ten times as many fainter lines, in the plane z = 0 around
/// what the camera looks at, as far as the picture shows the background: through what is
/// translucent by its share (Image::shares). Lines are `line_px` wide, and left out where they are
/// close.
void draw_ground_grid(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                      const ColorScheme& scheme, double line_px);

/// Draws marks and numbers along the six half-axes, up to the camera's distance. The numbers lie in
/// the planes in which OpenSCAD draws them, so that from some sides they are seen edge-on or
/// mirrored.
void draw_scale_marks(LinePainter& painter, const Camera& camera);

}  // namespace frontend
