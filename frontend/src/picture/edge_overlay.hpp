// Draws --view=edges: the lines that a draughtsman would draw.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// Draws the creases and outlines that the measured channels show, 1 px wide, in a colour half way
/// between the surface's and `background`. A surface that continues smoothly has no edges, whatever
/// primitives it is made of. Precondition: the image has its measured channels and the view's size.
void draw_edges(csgcore::Image& image, const csgcore::View& view, Rgb background);

}  // namespace frontend
