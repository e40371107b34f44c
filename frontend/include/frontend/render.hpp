// Draws a scene from a camera: the seam between the command line and the renderers.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"

namespace frontend {

/// Draws the scene; no display is needed. If kAuto chooses OpenGL, and OpenGL fails or turns out to
/// run in software, the CPU draws. Throws Error if kGl is asked for and OpenGL is not available.
csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats);

/// Returns whether another program has to draw: OpenGL is asked for, or may be chosen since there
/// is a GPU, but is not in this program.
bool needs_gl_program(const RenderSettings& settings);

}  // namespace frontend
