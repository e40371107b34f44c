// World space → the picture.
#pragma once

#include <optional>

#include "csgcore/view.hpp"

namespace window {

/// From the picture's upper left corner; a pixel's centre is at ½.
struct PicturePoint {
  double x_px;
  double y_px;
};

/// Where a point is seen; nothing if it lies behind the eye of a perspective view, or in its plane.
std::optional<PicturePoint> project(const csgcore::View& view, const csgcore::Vec3& point);

}  // namespace window
