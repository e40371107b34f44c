#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "panels/panels.hpp"
#include "panels/style.hpp"

namespace window {
namespace {

/// Returns what the user should know of the time of such a design; empty: nothing.
const char* limit_of_time(const State& state) {
  if (!state.version || !state.version->design || state.version->source.evaluation) return "";
  return state.version->parameters ? "openscad evaluates: variables of the top level do not know $t"
                                   : "a .csg has no time";
}

constexpr const char* kRate = "FPS";
constexpr const char* kSteps = "steps";

// In heights of the font.
constexpr float kNumber = 3.5f, kLeastSlider = 8;

/// Returns the width that both numbers take behind the slider.
float numbers_width() {
  const ImGuiStyle& style = ImGui::GetStyle();
  return 2 * (kNumber * ImGui::GetFontSize() + style.ItemInnerSpacing.x + style.ItemSpacing.x) +
         text_width(kRate) + text_width(kSteps);
}

/// Draws an integer that is dragged, or typed after a double click.
bool drag_number(const char* label, int& number, int most) {
  ImGui::SetNextItemWidth(kNumber * ImGui::GetFontSize());
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
    // The numbers stand below where the slider would be short beside them.
    const float room = ImGui::GetContentRegionAvail().x;
    const float beside = room - numbers_width();
    const bool is_beside = beside >= kLeastSlider * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(is_beside ? beside : room);
    if (ImGui::SliderInt("##time", &frame, 0, animation.steps() - 1, time)) {
      animation.seek(frame, now);
    }
    if (is_beside) ImGui::SameLine();
    int rate = animation.frames_per_second(), steps = animation.steps();
    if (drag_number(kRate, rate, Animation::kMostFrames_s)) {
      animation.set_frames_per_second(rate, now);
    }
    ImGui::SameLine();
    if (drag_number(kSteps, steps, Animation::kMostSteps)) animation.set_steps(steps, now);
    if (const char* limit = limit_of_time(state); *limit != '\0') {
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
      ImGui::TextWrapped("%s", limit);
      ImGui::PopStyleColor();
    }
  }
  const float top = ImGui::GetWindowPos().y;
  ImGui::End();
  return top;
}

}  // namespace window
