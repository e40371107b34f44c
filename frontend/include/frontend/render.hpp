// Scene and camera → Image: the seam between the command line and the renderers.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"

namespace frontend {

/// Draws the scene, without a display. Where kAuto takes OpenGL and that fails, or turns out to run
/// in software, the CPU draws. Throws Error if kGl is asked for and no OpenGL can be had.
csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats);

}  // namespace frontend
