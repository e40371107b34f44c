#include "panels.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

#include "frontend/color_scheme.hpp"
#include "projection.hpp"

namespace window {
namespace {

using csgcore::Vec3;

constexpr ImU32 kErrorColor = IM_COL32(255, 120, 110, 255);
constexpr ImU32 kWarningColor = IM_COL32(255, 214, 102, 255);
constexpr ImU32 kTextColor = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kPointColor = IM_COL32(220, 30, 90, 255);
constexpr ImU32 kShadowColor = IM_COL32(255, 255, 255, 220);

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_AlwaysAutoResize;

/// The gestures of OpenSCAD (frontend/OPENSCAD.md, "Window"), and our own.
constexpr const char* kMouse[][2] = {
    {"Left drag", "turn; with shift: about y"},
    {"Right drag", "pan"},
    {"Middle drag", "forward and back; also shift + right drag"},
    {"Wheel", "zoom at the cursor"},
    {"Click", "measure: the place, the primitive, its line in the .csg"},
    {"Second click", "the distance between the two"},
    {"Double click", "centre on the point"},
    {"Ctrl + left drag", "drag the section plane"},
};

constexpr const char* kMenuNames[] = {"File", "View", "Show", "Section", "Help"};

std::string coordinates(const Vec3& v) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, "[%.6g, %.6g, %.6g]", v.x, v.y, v.z);
  return buffer;
}

ImU32 color_of_line(const std::string& line) {
  if (line.find("ERROR") != std::string::npos || line.find("error: ") != std::string::npos) {
    return kErrorColor;
  }
  if (line.find("WARNING") != std::string::npos || line.find("warning: ") != std::string::npos) {
    return kWarningColor;
  }
  return kTextColor;
}

void colored_text(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// Writes a label, moved to the left if it would leave the window.
void label(ImDrawList& list, ImVec2 at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  at.x = std::max(4.0f, std::min(at.x, ImGui::GetIO().DisplaySize.x - size.x - 4));
  list.AddRectFilled({at.x - 3, at.y - 2}, {at.x + size.x + 3, at.y + size.y + 2}, kShadowColor, 3);
  list.AddText(at, kPointColor, text.c_str());
}

}  // namespace

void Panels::draw(State& state, const csgcore::View& view) {
  draw_points(state, view);
  draw_menu_bar(state);
  const float status_top = draw_status(state);
  draw_messages(state, status_top);
  draw_section(state);
  draw_help(state);
  draw_save_dialogue(state);
}

void Panels::draw_menu_bar(State& state) {
  if (!ImGui::BeginMainMenuBar()) return;
  for (std::size_t menu = 0; menu < std::size(kMenuNames); ++menu) {
    if (!ImGui::BeginMenu(kMenuNames[menu])) continue;
    for (const CommandRow& row : command_rows()) {
      if (row.menu != static_cast<Menu>(menu)) continue;
      if (row.starts_group) ImGui::Separator();
      if (ImGui::MenuItem(row.label, row.shortcut, state.is_checked(row.command))) {
        run_(row.command);
      }
    }
    if (static_cast<Menu>(menu) == Menu::kShow) draw_schemes(state);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

void Panels::draw_schemes(State& state) {
  ImGui::Separator();
  if (ImGui::BeginMenu("Colours")) {
    for (const frontend::ColorScheme& scheme : frontend::color_schemes()) {
      const bool is_chosen = std::string_view(scheme.name) == state.look.scheme.name;
      if (ImGui::MenuItem(scheme.name, nullptr, is_chosen)) state.look.scheme = scheme;
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Smooth edges")) {
    for (const uint32_t samples : {1u, 4u, 16u, frontend::kMaxSamples}) {
      const std::string name = samples == 1 ? "off" : std::to_string(samples) + " rays a pixel";
      if (ImGui::MenuItem(name.c_str(), nullptr, state.look.samples == samples)) {
        state.look.samples = samples;
      }
    }
    ImGui::EndMenu();
  }
}

/// Returns the upper end of the status line.
float Panels::draw_status(const State& state) const {
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
  if (ImGui::Begin("##status", nullptr, kBar | ImGuiWindowFlags_NoInputs)) {
    ImGui::PushTextWrapPos(padding.x + width);
    ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  return size.y - height;
}

void Panels::draw_messages(const State& state, float bottom) const {
  std::vector<std::string> lines;
  if (state.version) {
    if (!state.version->error.empty()) lines.push_back(state.version->error);
    if (state.shows_messages) {
      lines.insert(lines.end(), state.version->messages.begin(), state.version->messages.end());
    }
  }
  if (state.painting && !state.painting->error.empty()) lines.push_back(state.painting->error);
  if (lines.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::max(display.x - 20, 50.0f);
  ImGui::SetNextWindowPos({10, bottom - 8}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y / 2});
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##messages", nullptr, kOverlay & ~ImGuiWindowFlags_NoScrollbar)) {
    for (const std::string& line : lines) colored_text(color_of_line(line), line);
  }
  ImGui::End();
}

void Panels::draw_section(State& state) const {
  if (!state.section.is_on || state.bounds().empty()) return;
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
  ImGui::End();
}

void Panels::draw_points(const State& state, const csgcore::View& view) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  std::vector<std::optional<ImVec2>> places;
  for (const MeasuredPoint& point : state.points) {
    const std::optional<PicturePoint> place = project(view, point.position);
    places.push_back(place ? std::optional(ImVec2(static_cast<float>(place->x_px),
                                                  static_cast<float>(place->y_px)))
                           : std::nullopt);
  }
  if (places.size() == 2 && places[0] && places[1]) {
    list.AddLine(*places[0], *places[1], kShadowColor, 4);
    list.AddLine(*places[0], *places[1], kPointColor, 2);
    const Vec3 apart = state.points[1].position - state.points[0].position;
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", glm::length(apart));
    label(list, {(places[0]->x + places[1]->x) / 2 + 8, (places[0]->y + places[1]->y) / 2},
          std::string(text) + "  " + coordinates(apart));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    list.AddCircleFilled(*places[i], 5, kShadowColor);
    list.AddCircleFilled(*places[i], 3.5f, kPointColor);
    // Labels are above the first point and below the second, which leaves room between them.
    const float line = ImGui::GetTextLineHeight() + 4;
    const float top = places[i]->y + (i == 0 ? -2 * line - 8 : 12);
    label(list, {places[i]->x, top}, coordinates(state.points[i].position));
    label(list, {places[i]->x, top + line}, state.points[i].primitive);
  }
}

void Panels::draw_help(State& state) const {
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

void Panels::draw_save_dialogue(State& state) {
  constexpr const char* kName = "Save picture";
  if (state.asks_for_path) {
    state.asks_for_path = false;
    ImGui::OpenPopup(kName);
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(std::min(30 * ImGui::GetFontSize(), 0.8f * size.x));
  const bool entered =
      ImGui::InputText("##path", &state.picture_path, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::TextUnformatted(".png or .exr, as -o writes it, in the size of the window");
  if (entered || ImGui::Button("Save")) {
    save_(state.picture_path);
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace window
