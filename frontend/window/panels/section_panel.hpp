// The section plane's axis, side and position.
#pragma once

#include "state.hpp"

namespace window {

void draw_section(State& state);

}  // namespace window
