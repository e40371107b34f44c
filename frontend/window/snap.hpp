// What a click snaps to: a vertex, an edge or the centre of a circle of the visible surface.
#pragma once

#include <optional>

#include "model_rays.hpp"

namespace window {

/// Returns what is seen within `reach_px` of a click: the nearest vertex, or else the nearest
/// centre of a circle, or else the nearest edge. Edges are those between two faces, and between a
/// face and what is round about an axis across it; they need not be a primitive's own. The hit is
/// that of a face beside, and its surface is kVertex, kEdge or kCircle.
std::optional<RayHit> snap(const ModelRays& rays, const csgcore::View& view,
                           const PicturePoint& click, double reach_px);

}  // namespace window
