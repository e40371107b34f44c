// The measured points and their distance, drawn over the picture.
#pragma once

#include "csgcore/view.hpp"
#include "panels/label_layout.hpp"
#include "state.hpp"

namespace window {

/// What labels keep clear of, besides the menu bar; in ImGui's units.
struct LabelRoom {
  float bottom = 0;  // where other panels begin
  LabelBox place{};  // the panel of the place
};

/// `view` is that of the picture, in ImGui's units.
void draw_points(const State& state, const csgcore::View& view, const LabelRoom& room);

}  // namespace window
