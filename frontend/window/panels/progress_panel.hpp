// What the user waits for, how long already, and how to end it.
#pragma once

#include "panels/menu_bar.hpp"
#include "state.hpp"

namespace window {

/// Draws nothing while nothing takes long. `run` is called with Command::kStop.
void draw_progress(const State& state, const RunCommand& run);

}  // namespace window
