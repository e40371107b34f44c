// The sheet of the mouse's gestures and of all keys.
#pragma once

#include "state.hpp"

namespace window {

void draw_help(State& state);

}  // namespace window
