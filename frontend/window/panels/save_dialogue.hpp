// Asks for the path of a picture.
#pragma once

#include <functional>
#include <string>

#include "state.hpp"

namespace window {

using SavePicture = std::function<void(const std::string& path)>;

/// `save` is called with the path that is entered.
void draw_save_dialogue(State& state, const SavePicture& save);

}  // namespace window
