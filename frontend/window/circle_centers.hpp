// The centres of the circles in which round walls end: of holes, pins and countersinks.
#pragma once

#include <optional>

#include "model_rays.hpp"

namespace window {

/// Returns the nearest centre, within `reach_px` of a click, of a circle of which something is
/// seen. Where several are behind each other, it is the nearest to the eye.
std::optional<RayHit> center_of_circle(const ModelRays& rays, const csgcore::View& view,
                                       const PicturePoint& click, double reach_px);

}  // namespace window
