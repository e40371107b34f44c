// Draws --view=edges on primitives that are drawn as OpenSCAD's meshes.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/render_settings.hpp"
#include "picture/mesh_lookup.hpp"

namespace frontend {

/// Draws the edges of the meshes on the faces beside them that are seen, as OpenSCAD's preview does
/// (frontend/OPENSCAD.md, "Edges"). No line is drawn where two primitives meet. Precondition: the
/// image has its measured channels and the view's size.
void draw_facet_edges(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                      const ColorScheme& scheme, const MeshLookup& meshes);

}  // namespace frontend
