// The design's parameters and their sets.
#pragma once

#include "state.hpp"

namespace window {

/// Draws them at the left side, above `bottom`, if they are switched on and there are any. Returns
/// the right end of the room that they take.
float draw_customizer(State& state, float bottom);

}  // namespace window
