// The place of the last measured point in the design's text, and what is round or flat there.
#pragma once

#include "csgcore/view.hpp"
#include "panels/label_layout.hpp"
#include "panels/menu_bar.hpp"
#include "panels/section_panel.hpp"
#include "state.hpp"

namespace window {

/// The part of the window that other panels leave free, in ImGui's units.
struct FreeRoom {
  float left = 0;
  float bottom = 0;
  SectionCorner section{};
};

/// Returns the height that the panel takes at the room's lower end, if there is little room for it
/// beside the parameters; else 0.
float height_below_parameters(const State& state, const FreeRoom& room);

/// `view` is that of the picture, in ImGui's units. `run` is called with the command that opens the
/// editor. Returns the panel's place; it is empty if there is none.
LabelBox draw_place(State& state, const csgcore::View& view, const FreeRoom& room,
                    const RunCommand& run);

}  // namespace window
