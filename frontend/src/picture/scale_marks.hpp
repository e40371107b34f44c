// OpenSCAD's --view=scales.
#pragma once

#include "picture/overlay_lines.hpp"

namespace frontend {

/// Draws marks and numbers along the six half-axes, up to the camera's distance. The numbers lie in
/// the planes that OpenSCAD draws them in: they are seen from the side where they are not.
void draw_scale_marks(LinePainter& painter, const Camera& camera);

}  // namespace frontend
