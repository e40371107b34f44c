// Draws everything that lies over the picture; each panel has a file of its own.
#pragma once

#include "csgcore/view.hpp"
#include "panels/menu_bar.hpp"
#include "panels/message_panel.hpp"
#include "panels/open_dialogue.hpp"
#include "panels/save_dialogue.hpp"
#include "state.hpp"

namespace window {

/// What the panels ask of the application.
struct PanelActions {
  RunCommand run;  // for commands that State::apply() does not do
  SavePicture save;
  OpenPlace open;
  OpenDesign open_design{};
};

/// To be called within a frame of ImGui. `view` is that of the picture shown, in ImGui's units,
/// each of which is `pixels_per_unit` of the picture's pixels.
void draw_panels(State& state, const csgcore::View& view, float pixels_per_unit,
                 const PanelActions& actions);

}  // namespace window
