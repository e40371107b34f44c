// What is wrong with the design, and what its evaluation has said.
#pragma once

#include <functional>

#include "message_list.hpp"
#include "state.hpp"

namespace window {

using OpenPlace = std::function<void(const MessagePlace& place)>;

/// `bottom` is the lower end of the room for it, in ImGui's units. `open` is called with the place
/// of a message that is clicked. Errors are shown even if the panel is closed.
/// Returns the panel's upper end, or `bottom` if there is none.
float draw_messages(State& state, float bottom, const OpenPlace& open);

}  // namespace window
