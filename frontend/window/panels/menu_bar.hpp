// The menu bar, made from the table of commands.
#pragma once

#include <functional>

#include "panels/open_dialogue.hpp"
#include "state.hpp"

namespace window {

using RunCommand = std::function<void(Command)>;

/// `run` is called with the command that is chosen, `open` with the path of a recent design.
void draw_menu_bar(State& state, const RunCommand& run, const OpenDesign& open);

}  // namespace window
