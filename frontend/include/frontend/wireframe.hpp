// Draws the edges and vertices of a solid, as OpenSCAD's --render --view=wireframe does.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/solid_edges.hpp"

namespace frontend {

/// Draws edges as lines 5 px wide and vertices as squares of 10 px, where nothing that the image
/// shows is in front of them. Precondition: the image has its z channel and the view's size.
void draw_wireframe(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                    const SolidEdges& edges, const ColorScheme& scheme);

}  // namespace frontend
