// The place of the last measured point in the design's text, and what is round or flat there.
#pragma once

#include "csgcore/view.hpp"
#include "panels/menu_bar.hpp"
#include "state.hpp"

namespace window {

/// The part of the window that other panels leave free, in ImGui's units.
struct FreeRoom {
  float left = 0;
  float bottom = 0;
};

/// `view` is that of the picture, in ImGui's units. `run` is called with the command that opens the
/// editor.
void draw_place(State& state, const csgcore::View& view, const FreeRoom& room,
                const RunCommand& run);

}  // namespace window
