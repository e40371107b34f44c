// A drag that pans: the point that was under the mouse at its begin stays there.
#pragma once

#include <cstdint>

#include "navigation.hpp"

namespace window {

/// How far that point is before the eye becomes known only after a while.
struct Pan {
  uint64_t probe = 0;  // that finds the point; 0: nothing is panned
  Navigation start{{}, csgcore::Projection::kPerspective};
  Navigation now = start;  // as the pan has left it
  double dx_px = 0, dy_px = 0;
  double depth = 0;

  /// Goes on from a camera, which something else may have moved meanwhile.
  Navigation move(const Navigation& from, double x_px, double y_px, Size size) {
    if (!(from == now)) {
      start = from;
      dx_px = dy_px = 0;
    }
    dx_px += x_px;
    dy_px += y_px;
    now = start;
    now.pan(dx_px, dy_px, size, depth);
    return now;
  }
};

}  // namespace window
