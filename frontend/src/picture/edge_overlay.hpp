// --view=edges: the lines that a draughtsman would draw of the solid.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// Draws the creases and outlines that the measured channels show, 1 px wide, in the surface's
/// colour half way to `background`. There are none where a surface goes on smoothly, whatever
/// primitives it is made of. Precondition: the image has its measured channels and the view's size.
void draw_edges(csgcore::Image& image, const csgcore::View& view, Rgb background);

}  // namespace frontend
