#include <imgui.h>

#include "panels/panels.hpp"

namespace window {

SectionCorner draw_section(State& state) {
  if (!state.section.is_on || state.bounds().empty()) return {ImGui::GetIO().DisplaySize.x, 0};
  SectionPlane& section = state.section;
  const csgcore::Box box = state.bounds();
  const float right = ImGui::GetIO().DisplaySize.x - 10;
  ImGui::SetNextWindowPos({right, ImGui::GetFrameHeight() + 10}, ImGuiCond_Always, {1, 0});
  if (ImGui::Begin("Section##section", nullptr,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoFocusOnAppearing)) {
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (uint8_t axis = 0; axis < 3; ++axis) {
      if (axis > 0) ImGui::SameLine();
      if (ImGui::RadioButton(kAxes[axis], section.axis == axis)) state.set_section_axis(axis);
    }
    ImGui::SameLine();
    ImGui::Checkbox("other side", &section.is_flipped);
    ImGui::SetNextItemWidth(14 * ImGui::GetFontSize());
    ImGui::SliderScalar("##position", ImGuiDataType_Double, &section.position,
                        &box.min[section.axis], &box.max[section.axis], "%.6g");
  }
  const SectionCorner corner{ImGui::GetWindowPos().x,
                             ImGui::GetWindowPos().y + ImGui::GetWindowHeight()};
  ImGui::End();
  return corner;
}

}  // namespace window
