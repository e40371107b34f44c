// Draws OpenSCAD's --view=axes.
#pragma once

#include "picture/overlay_lines.hpp"

namespace frontend {

/// Draws the world's axes from −camera.distance to +camera.distance, the negative halves stippled.
void draw_axes(LinePainter& painter, const Camera& camera);

/// Draws the red, green and blue axes in the lower left corner, over everything.
void draw_gnomon(Canvas& canvas, const csgcore::View& view, Rgb label_color);

}  // namespace frontend
