// The colours and the window flags that the panels share.
#pragma once

#include <imgui.h>

namespace window {

inline constexpr ImU32 kErrorColor = IM_COL32(255, 120, 110, 255);
inline constexpr ImU32 kWarningColor = IM_COL32(255, 214, 102, 255);
inline constexpr ImU32 kTextColor = IM_COL32(235, 235, 235, 255);

/// A window of ImGui that lies over the picture, without a title and in a place of its own.
inline constexpr ImGuiWindowFlags kOverlay =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;

}  // namespace window
