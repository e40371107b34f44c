#include "panels/hover_tip.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>

namespace window {

void draw_hover_tip(const State& state, float pixels_per_unit) {
  if (!state.hovered || state.shows_help || ImGui::GetIO().WantCaptureMouse) return;
  const std::string text = hover_text(*state.hovered);
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float most = std::max(display.x - 2 * padding.x, 1.0f);
  ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
  size = {size.x + 2 * padding.x, size.y + 2 * padding.y};
  const ImVec2 mouse(static_cast<float>(state.hovered->at.x_px) / pixels_per_unit,
                     static_cast<float>(state.hovered->at.y_px) / pixels_per_unit);
  // Below the pointer, or above it where there is no room.
  const float below = mouse.y + 1.5f * ImGui::GetFontSize();
  const ImVec2 at(std::clamp(mouse.x, 0.0f, std::max(display.x - size.x, 0.0f)),
                  below + size.y <= display.y ? below : mouse.y - size.y - 4);
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::BeginTooltip();  // which lies over the panels
  ImGui::PushTextWrapPos(padding.x + most);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace window
