// What is wrong with the design, and what its evaluation has said.
#pragma once

#include "state.hpp"

namespace window {

/// `bottom` is the lower end of the room for it, in ImGui's units.
void draw_messages(const State& state, float bottom);

}  // namespace window
