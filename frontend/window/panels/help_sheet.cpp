#include "panels/help_sheet.hpp"

#include <imgui.h>

#include <algorithm>

#include "commands.hpp"
#include "panels/fitted_text.hpp"

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

template <typename Row>
void each_row(const Row& row) {
  for (const auto& [what, does] : kMouse) row(what, does);
  for (const CommandRow& command : command_rows()) {
    if (*command.shortcut != '\0') row(command.shortcut, command.label);
  }
}

/// The widths of both columns, without the space between them.
struct Columns {
  float what = 0, does = 0;
};

/// Returns columns of which the second is narrower than its texts where `width` is not enough.
Columns columns_of(float width) {
  Columns columns;
  each_row([&](const char* what, const char* does) {
    columns.what = std::max(columns.what, text_width(what));
    columns.does = std::max(columns.does, text_width(does));
  });
  columns.does = std::min(columns.does, std::max(width - columns.what, 1.0f));
  return columns;
}

}  // namespace

void draw_help(State& state, float bottom) {
  if (!state.shows_help) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float display = ImGui::GetIO().DisplaySize.x, top = ImGui::GetFrameHeight();
  const Columns columns = columns_of(display - 2 * style.WindowPadding.x - style.ScrollbarSize -
                                     2 * style.CellPadding.x);
  ImGui::SetNextWindowPos({display / 2, (top + bottom) / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display, bottom - top});
  if (ImGui::Begin("Mouse and keys", &state.shows_help,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
    if (ImGui::BeginTable("##keys", 2)) {
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, columns.what);
      ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed, columns.does);
      each_row([](const char* what, const char* does) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what);
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", does);
      });
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace window
