// Which pictures another program draws, since this one has no OpenGL in it.
#pragma once

#include "frontend/render_settings.hpp"

namespace frontend {

/// Returns whether OpenGL is asked for, or may be chosen since there is a GPU, but is not in this
/// program.
bool needs_gl_program(const RenderSettings& settings);

}  // namespace frontend
