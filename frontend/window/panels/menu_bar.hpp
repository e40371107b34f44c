// The menu bar, made from the table of commands.
#pragma once

#include <functional>

#include "state.hpp"

namespace window {

using RunCommand = std::function<void(Command)>;

/// `run` is called with the command that is chosen.
void draw_menu_bar(State& state, const RunCommand& run);

}  // namespace window
