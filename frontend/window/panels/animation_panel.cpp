#include "panels/animation_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "panels/style.hpp"

namespace window {
namespace {

/// Returns what the user should know of the time of such a design; empty: nothing.
const char* limit_of_time(const State& state) {
  if (!state.version || !state.version->design || state.version->texts.evaluation) return "";
  return state.version->parameters ? "openscad evaluates: variables of the top level do not know $t"
                                   : "a .csg has no time";
}

/// Draws an integer that is dragged, or typed after a double click.
bool drag_number(const char* label, int& number, int most) {
  ImGui::SetNextItemWidth(3.5f * ImGui::GetFontSize());
  const bool is_changed =
      ImGui::DragInt(label, &number, 0.25f, 1, most, "%d", ImGuiSliderFlags_AlwaysClamp);
  return is_changed;
}

}  // namespace

float draw_animation(State& state, float bottom) {
  if (!state.shows_animation) return bottom;
  const auto now = Animation::Clock::now();
  Animation& animation = state.animation;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::min(40 * ImGui::GetFontSize(), display.x - 20);
  ImGui::SetNextWindowPos({display.x / 2, bottom - 8}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y / 2});
  ImGui::SetNextWindowBgAlpha(0.9f);
  if (ImGui::Begin("##animation", nullptr, kOverlay)) {
    const float button = 4 * ImGui::GetFontSize();
    if (ImGui::Button(animation.is_playing() ? "Pause" : "Play", {button, 0})) {
      animation.is_playing() ? animation.pause() : animation.play(now);
    }
    ImGui::SameLine();
    int frame = animation.frame();
    char time[32];
    std::snprintf(time, sizeof time, "$t = %.4g", animation.time());
    ImGui::SetNextItemWidth(width - button - 15 * ImGui::GetFontSize());
    if (ImGui::SliderInt("##time", &frame, 0, animation.steps() - 1, time)) {
      animation.seek(frame, now);
    }
    ImGui::SameLine();
    int rate = animation.frames_per_second(), steps = animation.steps();
    if (drag_number("FPS", rate, Animation::kMostFrames_s)) {
      animation.set_frames_per_second(rate, now);
    }
    ImGui::SameLine();
    if (drag_number("steps", steps, Animation::kMostSteps)) animation.set_steps(steps, now);
    if (const char* limit = limit_of_time(state); *limit != '\0') ImGui::TextDisabled("%s", limit);
  }
  const float top = ImGui::GetWindowPos().y;
  ImGui::End();
  return top;
}

}  // namespace window
