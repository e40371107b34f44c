// Draws --view=edges on smooth primitives: the lines that a draughtsman would draw.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "picture/mesh_lookup.hpp"

namespace frontend {

/// Draws the creases and outlines that the measured channels show, 1 px wide, in a colour half way
/// between the surface's and `background`. A surface that continues smoothly has no edges, whatever
/// primitives it is made of. Primitives that have meshes get their edges from facet_edges.hpp: here
/// only what they share with other primitives is drawn. Precondition: the image has its measured
/// channels and the view's size.
void draw_edges(csgcore::Image& image, const csgcore::View& view, Rgb background,
                const MeshLookup& meshes);

}  // namespace frontend
