#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "panels/panels.hpp"
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

void draw_progress(const State& state, const RunCommand& run) {
  if (!state.long_activity) return;
  const frontend::Activity& activity = *state.long_activity;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - activity.since;
  const float width = ImGui::GetIO().DisplaySize.x;
  ImGui::SetNextWindowPos({width / 2, 1.5f * ImGui::GetFrameHeight()}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##progress", nullptr, kOverlay)) {
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%s, %.0f s", activity.stage.c_str(), elapsed.count());
    ImGui::SameLine();
    if (ImGui::Button("Stop (Esc)")) run(Command::kStop);
    if (activity.fraction >= 0) {
      const auto done = static_cast<float>(std::min(activity.fraction, 1.0));
      ImGui::ProgressBar(done, {ImGui::GetContentRegionAvail().x, 0.5f * ImGui::GetFontSize()}, "");
    }
  }
  ImGui::End();
}

}  // namespace window
