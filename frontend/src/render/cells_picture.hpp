// The leaf cells of a subdivision as boxes with their edges (paper, figure 5b), without OpenGL.
#pragma once

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/subdivision.hpp"

namespace frontend {

/// The cells that a surface crosses, as glrender draws them: the nearest face of the nearest box
/// (from within a box, its far face) in the frame's front colour, and `edge` along the edges. No
/// id.
csgcore::Image cells_picture(const csgcore::Subdivision& subdivision, const csgcore::View& view,
                             const csgcore::FrameSettings& frame, const glm::vec3& edge);

}  // namespace frontend
