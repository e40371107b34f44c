// The status line at the lower end of the window.
#pragma once

#include "state.hpp"

namespace window {

/// Returns the upper end of the status line, in ImGui's units.
float draw_status_line(const State& state);

}  // namespace window
