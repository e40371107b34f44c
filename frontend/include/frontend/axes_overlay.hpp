// OpenSCAD's --view=axes, drawn over a finished picture.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/render.hpp"

namespace frontend {

/// Draws the world's axes from −camera.distance to +camera.distance, 1 px wide, the negative halves
/// stippled, hidden where the model is in front; and the red, green and blue axes in the lower left
/// corner, over everything. Precondition: the image has its z channel and the view's size.
void draw_axes(csgcore::Image& image, const csgcore::View& view, const Camera& camera, Rgb color);

}  // namespace frontend
