// What the panels share: colours, window flags and lines of text.
#pragma once

#include <imgui.h>

#include <string>

namespace window {

inline constexpr ImU32 kErrorColor = IM_COL32(255, 120, 110, 255);
inline constexpr ImU32 kWarningColor = IM_COL32(255, 214, 102, 255);
inline constexpr ImU32 kTextColor = IM_COL32(235, 235, 235, 255);

/// The margin around panels, in ImGui's units.
inline constexpr float kPanelMargin = 10;

/// A window of ImGui that lies over the picture, without a title and in a place of its own.
inline constexpr ImGuiWindowFlags kOverlay =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;

/// Returns the width of a text, in ImGui's units and its present font.
float text_width(const std::string& text);

/// Returns the text as far as it fits into a width.
std::string cut_to(std::string text, float width);

/// Writes a line of text that the mouse or a key can choose, wrapped; keys can walk to it. Returns
/// whether it was chosen. What `has_place` is underlined under the mouse. Precondition: no other
/// line has the same place in ImGui's stack of ids.
bool text_line(ImU32 color, const std::string& text, bool has_place);

}  // namespace window
