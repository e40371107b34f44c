// Projects world space onto the picture.
#pragma once

#include <optional>

#include "csgcore/view.hpp"

namespace window {

/// A place counted from the picture's upper left corner; a pixel's centre is at ½.
struct PicturePoint {
  double x_px;
  double y_px;
};

/// Returns where a point is seen; nothing if a perspective view has it behind the eye or in its
/// plane.
std::optional<PicturePoint> project(const csgcore::View& view, const csgcore::Vec3& point);

/// Returns the size of a pixel at a point, in world units.
double pixel_size(const csgcore::View& view, const csgcore::Vec3& point);

}  // namespace window
