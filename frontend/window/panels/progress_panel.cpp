#include "panels/progress_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <chrono>

#include "panels/style.hpp"

namespace window {

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
