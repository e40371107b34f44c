// The sheet of the mouse's gestures and of all keys.
#pragma once

#include "state.hpp"

namespace window {

/// Draws it above `bottom` if it is switched on.
void draw_help(State& state, float bottom);

}  // namespace window
