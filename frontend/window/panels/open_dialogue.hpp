// Asks for the design to open.
#pragma once

#include <functional>
#include <string>

#include "state.hpp"

namespace window {

using OpenDesign = std::function<void(const std::string& path)>;

/// `open` is called with the path that is chosen.
void draw_open_dialogue(State& state, const OpenDesign& open);

}  // namespace window
