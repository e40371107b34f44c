// The place of the last measured point in the design's text, and what is round or flat there.
#pragma once

#include "csgcore/view.hpp"
#include "panels/menu_bar.hpp"
#include "state.hpp"

namespace window {

/// `view` is that of the picture, and `status_top` the upper end of the status line, in ImGui's
/// units. `run` is called with the command that opens the editor.
void draw_place(State& state, const csgcore::View& view, float status_top, const RunCommand& run);

}  // namespace window
