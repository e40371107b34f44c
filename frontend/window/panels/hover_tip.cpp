#include "panels/hover_tip.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "panels/style.hpp"

namespace window {

void draw_hover_tip(const State& state, float pixels_per_unit) {
  if (!state.hovered) return;
  const std::string text = hover_text(*state.hovered);
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImVec2 size = ImGui::CalcTextSize(text.c_str());
  size = {size.x + 2 * padding.x, size.y + 2 * padding.y};
  const ImVec2 mouse(static_cast<float>(state.hovered->at.x_px) / pixels_per_unit,
                     static_cast<float>(state.hovered->at.y_px) / pixels_per_unit);
  // Below the pointer, or above it where there is no room.
  const float below = mouse.y + 1.5f * ImGui::GetFontSize();
  const ImVec2 at(std::clamp(mouse.x, 0.0f, std::max(display.x - size.x, 0.0f)),
                  below + size.y <= display.y ? below : mouse.y - size.y - 4);
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##hover", nullptr, kOverlay | ImGuiWindowFlags_NoInputs)) {
    ImGui::TextUnformatted(text.c_str());
  }
  ImGui::End();
}

}  // namespace window
