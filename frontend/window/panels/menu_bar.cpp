#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/render_settings.hpp"
#include "panels/keyboard.hpp"
#include "panels/panels.hpp"
#include "panels/style.hpp"

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

/// Draws the menu of the recent designs, each by its name, and by its folder where a shortcut
/// would be.
void draw_recent(const State& state, const OpenDesign& open) {
  if (!ImGui::BeginMenu("Open recent", !state.recent_designs.empty())) return;
  std::optional<std::string> chosen;
  for (const std::string& path : state.recent_designs) {
    const std::filesystem::path whole(path);
    const float room = ImGui::GetIO().DisplaySize.x / 3;
    const std::string name = cut_to(whole.filename().string(), room) + "###" + path;
    const std::string folder = cut_to(whole.parent_path().string(), room);
    if (ImGui::MenuItem(name.c_str(), folder.c_str())) chosen = path;
  }
  ImGui::EndMenu();
  if (chosen) open(*chosen);
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

/// Gives the keys to the picture once no menu is open; ImGui would give them to some panel.
void leave_closed_menus(State& state) {
  const bool walks = keys_walk_menu_bar();
  if (state.shows_menus && !walks && !is_popup_open()) leave_panels();
  state.shows_menus = walks || (state.shows_menus && is_popup_open());
}

}  // namespace

void draw_menu_bar(State& state, const RunCommand& run, const OpenDesign& open) {
  if (!ImGui::BeginMainMenuBar()) return;
  if (std::exchange(state.enters_menus, false)) enter_menu_bar();
  const ImVec2 spacing(menu_spacing(), ImGui::GetStyle().ItemSpacing.y);
  for (std::size_t menu = 0; menu < std::size(kMenuNames); ++menu) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, spacing);
    const bool is_open = ImGui::BeginMenu(kMenuNames[menu]);
    ImGui::PopStyleVar();
    // A key that comes to a menu's name opens it.
    if (!is_open && is_come_to_menu()) ImGui::OpenPopup(kMenuNames[menu]);
    state.shows_menus |= is_open;
    if (!is_open) continue;
    for (const CommandRow& row : command_rows()) {
      if (row.menu != static_cast<Menu>(menu)) continue;
      if (row.starts_group) ImGui::Separator();
      if (ImGui::MenuItem(row.label, row.shortcut, state.is_checked(row.command))) {
        run(row.command);
      }
      if (row.command == Command::kOpenDesign) draw_recent(state, open);
    }
    if (static_cast<Menu>(menu) == Menu::kShow) draw_schemes(state);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
  leave_closed_menus(state);
}

}  // namespace window
