#include "panels/help_sheet.hpp"

#include <imgui.h>

#include "commands.hpp"

namespace window {
namespace {

/// The gestures of OpenSCAD (frontend/OPENSCAD.md, "Window"), and our own.
constexpr const char* kMouse[][2] = {
    {"Left drag", "turn; with shift: about y"},
    {"Right drag", "pan"},
    {"Middle drag", "forward and back; also shift + right drag"},
    {"Wheel", "zoom at the cursor"},
    {"Click", "measure: the point, its leaf, and the place of that in the design"},
    {"Second click", "the distance between the two"},
    {"Rest", "name the leaf under the mouse"},
    {"Double click", "centre on the point"},
    {"Ctrl + left drag", "drag the section plane"},
};

}  // namespace

void draw_help(State& state) {
  if (!state.shows_help) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x, size.y - 2 * ImGui::GetFrameHeight()});
  if (ImGui::Begin("Mouse and keys", &state.shows_help,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    if (ImGui::BeginTable("##keys", 2)) {
      const auto row = [](const char* what, const char* does) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(does);
      };
      for (const auto& [what, does] : kMouse) row(what, does);
      for (const CommandRow& command : command_rows()) {
        if (*command.shortcut != '\0') row(command.shortcut, command.label);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace window
