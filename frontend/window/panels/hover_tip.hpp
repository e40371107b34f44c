// Names the leaf under the resting mouse.
#pragma once

#include "state.hpp"

namespace window {

/// `pixels_per_unit` are the picture's pixels in ImGui's unit.
void draw_hover_tip(const State& state, float pixels_per_unit);

}  // namespace window
