// The measured points and their distance, drawn over the picture.
#pragma once

#include "csgcore/view.hpp"
#include "state.hpp"

namespace window {

/// `view` is that of the picture, in ImGui's units.
void draw_points(const State& state, const csgcore::View& view);

}  // namespace window
