// Draws lines in space over a finished picture, where the model does not hide them.
#pragma once

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "picture/overlay_canvas.hpp"

namespace frontend {

enum class LineStyle : uint8_t {
  kSolid,
  kStippled,  // 3 pixels off, 3 on, as in OpenSCAD
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
  csgcore::Vec3 to_eye(const csgcore::Vec3& point) const;
  bool clip(csgcore::Vec3& point, const csgcore::Vec3& other) const;
  ScreenPoint to_screen(const csgcore::Vec3& point_eye) const;

  Canvas& canvas_;
  const csgcore::View& view_;
  double distance_;
  bool is_perspective_;
};

}  // namespace frontend
