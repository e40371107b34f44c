// The final render of a plane figure, which OpenSCAD draws flat, without light, and with outlines.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// Gives the plates, whose faces lie in planes of constant z, the colour that the light turns into
/// the scheme's colour of plane figures.
void color_flat_figure(csgcore::Scene& scene, const csgcore::View& view, const ColorScheme& scheme);

/// Draws the outlines, 2 px wide.
void draw_flat_outlines(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                        const ImportedDesign& design, const ColorScheme& scheme);

}  // namespace frontend
