// The section plane's axis, side and position.
#pragma once

#include "state.hpp"

namespace window {

/// The lower left corner of the panel, in ImGui's units.
struct SectionCorner {
  float left = 0;
  float bottom = 0;
};

/// Draws them in the upper right corner if the plane is on. Without it the corner is beyond the
/// window's.
SectionCorner draw_section(State& state);

}  // namespace window
