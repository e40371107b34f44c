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

/// Returns the nearest centre, within `reach_px` of a click, of a circle, in which a hole, a pin or
/// a countersink ends, and of which something is seen. Where several are behind each other, it is
/// the nearest to the eye.
std::optional<RayHit> center_of_circle(const ModelRays& rays, const csgcore::View& view,
                                       const PicturePoint& click, double reach_px);

}  // namespace window
