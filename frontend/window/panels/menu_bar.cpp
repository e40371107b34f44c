#include "panels/menu_bar.hpp"

#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "frontend/color_scheme.hpp"
#include "panels/fitted_text.hpp"

namespace window {
namespace {

constexpr const char* kMenuNames[] = {"File", "View", "Show", "Section", "Help"};

void draw_schemes(State& state) {
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

/// Returns the space between the menus' names, which a narrow window makes smaller. ImGui takes it
/// twice for each name.
float menu_spacing() {
  float names = 0;
  for (const char* name : kMenuNames) names += text_width(name);
  const float rest = ImGui::GetIO().DisplaySize.x - names;
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  return std::clamp(rest / (2 * std::size(kMenuNames) + 1), 1.0f, spacing);
}

}  // namespace

void draw_menu_bar(State& state, const RunCommand& run) {
  if (!ImGui::BeginMainMenuBar()) return;
  const ImVec2 spacing(menu_spacing(), ImGui::GetStyle().ItemSpacing.y);
  for (std::size_t menu = 0; menu < std::size(kMenuNames); ++menu) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, spacing);
    const bool is_open = ImGui::BeginMenu(kMenuNames[menu]);
    ImGui::PopStyleVar();
    if (!is_open) continue;
    for (const CommandRow& row : command_rows()) {
      if (row.menu != static_cast<Menu>(menu)) continue;
      if (row.starts_group) ImGui::Separator();
      if (ImGui::MenuItem(row.label, row.shortcut, state.is_checked(row.command))) {
        run(row.command);
      }
    }
    if (static_cast<Menu>(menu) == Menu::kShow) draw_schemes(state);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

}  // namespace window
