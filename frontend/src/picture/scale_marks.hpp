// Draws OpenSCAD's --view=scales.
#pragma once

#include "picture/overlay_lines.hpp"

namespace frontend {

/// Draws marks and numbers along the six half-axes, up to the camera's distance. The numbers lie in
/// the planes in which OpenSCAD draws them, so that from some sides they are seen edge-on or
/// mirrored.
void draw_scale_marks(LinePainter& painter, const Camera& camera);

}  // namespace frontend
