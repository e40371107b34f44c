// The design's time: play, pause, and a slider.
#pragma once

#include "state.hpp"

namespace window {

/// Draws it above `bottom`, if it is switched on. Returns its upper end.
float draw_animation(State& state, float bottom);

}  // namespace window
