// Texts that have to fit into a width, in ImGui's units and its present font.
#pragma once

#include <string>

namespace window {

float text_width(const std::string& text);

/// Returns the text as far as it fits into a width.
std::string cut_to(std::string text, float width);

}  // namespace window
