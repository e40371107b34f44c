// The program `scadray`, from its arguments to its exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"
#include "frontend/run_program.hpp"

namespace frontend {

/// frontend::render, or a function with the same contract.
using Renderer = std::function<csgcore::Image(const csgcore::Scene&, const csgcore::View&,
                                              const RenderSettings&, RenderStats&)>;

/// Whether pictures by these settings are drawn by scadray-gl; empty: none are.
using GlProgramChoice = std::function<bool(const RenderSettings&)>;

/// Runs the command. If the first argument is `bench`, `serve` or `validate`, the program
/// scadray-bench and so on runs in place of this one; for a window scadray-window, and scadray-gl
/// where it draws. Messages go to stderr; nothing is thrown.
ExitCode run_command(const std::vector<std::string>& arguments, const Renderer& renderer,
                     const GlProgramChoice& drawn_by_gl_program = {});

}  // namespace frontend
