// A line of text that the mouse or a key can choose.
#pragma once

#include <imgui.h>

#include <string>

namespace window {

/// Writes a text, wrapped; keys can walk to it. Returns whether it was chosen. What `has_place` is
/// underlined under the mouse. Precondition: no other line has the same place in ImGui's stack of
/// ids.
bool text_line(ImU32 color, const std::string& text, bool has_place);

}  // namespace window
