#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "panels/panels.hpp"

namespace window {
namespace {

/// A lower window has no room for the normal beside other panels; the mouse turns the plane there.
constexpr float kLeastHeight = 40;

/// Draws the plane's normal, whose numbers are dragged or typed.
void draw_normal(State& state) {
  csgcore::Vec3 normal = state.section.normal;
  const csgcore::Vec3 middle = state.section_middle();
  ImGui::SetNextItemWidth(14 * ImGui::GetFontSize());
  if (!ImGui::DragScalarN("##normal", ImGuiDataType_Double, &normal.x, 3, 0.01f, nullptr, nullptr,
                          "%.3f")) {
    return;
  }
  const double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) return;
  state.section.normal = normal / length;
  state.section.position = glm::dot(middle, state.section.normal);
}

}  // namespace

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
    constexpr const char* kAxisNames[] = {"x", "y", "z"};
    for (uint8_t axis = 0; axis < 3; ++axis) {
      if (axis > 0) ImGui::SameLine();
      if (ImGui::RadioButton(kAxisNames[axis], section.axis() == axis)) {
        state.set_section_normal(axis_of(axis));
      }
    }
    ImGui::SameLine();
    ImGui::Checkbox("other side", &section.is_flipped);
    const auto [low, high] = positions_in(box, section.normal);
    ImGui::SetNextItemWidth(14 * ImGui::GetFontSize());
    ImGui::SliderScalar("##position", ImGuiDataType_Double, &section.position, &low, &high, "%.6g");
    if (ImGui::GetIO().DisplaySize.y >= kLeastHeight * ImGui::GetFontSize()) draw_normal(state);
  }
  const SectionCorner corner{ImGui::GetWindowPos().x,
                             ImGui::GetWindowPos().y + ImGui::GetWindowHeight()};
  ImGui::End();
  return corner;
}

}  // namespace window
