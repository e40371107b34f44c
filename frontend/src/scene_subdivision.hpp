// The kd-tree of a solid by the command's settings, timed and counted.
#pragma once

#include "csgcore/subdivision.hpp"
#include "frontend/render.hpp"

namespace frontend {

csgcore::SubdivisionOptions subdivision_options(const csgcore::View& view,
                                                const RenderSettings& settings);

/// Subdivides the model, reports progress, and fills the stats' subdivision.
csgcore::Subdivision subdivide_model(const csgcore::Solid& solid, const csgcore::View& view,
                                     const RenderSettings& settings, RenderStats& stats);

}  // namespace frontend
