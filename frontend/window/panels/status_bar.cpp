#include "panels/status_bar.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "panels/style.hpp"

namespace window {

float draw_status_line(const State& state) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (!state.shows_status) return size.y;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float width = std::max(size.x - 2 * padding.x, 1.0f);
  const auto fits = [width](const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x <= width;
  };
  // A line that cannot be shortened is wrapped.
  const std::string line = state.notice.empty() ? status_line(state, fits) : state.notice;
  const float height = ImGui::CalcTextSize(line.c_str(), nullptr, false, width).y + 2 * padding.y;
  ImGui::SetNextWindowPos({0, size.y - height});
  ImGui::SetNextWindowSize({size.x, height});
  constexpr ImGuiWindowFlags kBar = kOverlay & ~ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});  // one line is less than the usual
  if (ImGui::Begin("##status", nullptr, kBar | ImGuiWindowFlags_NoInputs)) {
    ImGui::PushTextWrapPos(padding.x + width);
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar();
  return size.y - height;
}

}  // namespace window
