#include "panels/keyboard.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // which window has ImGui's focus, and whether that is shown

#include <algorithm>
#include <tuple>
#include <vector>

namespace window {
namespace {

/// Gives a window the keys, from its first item on.
void enter(ImGuiWindow* window) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  ImGui::FocusWindow(window);
  ImGui::NavInitWindow(window, true);
  context.NavDisableHighlight = false;
  context.NavDisableMouseHover = true;
}

/// Returns the panel that a key has entered; null if the picture has the keys.
ImGuiWindow* entered_panel() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.NavWindow == nullptr || context.NavDisableHighlight) return nullptr;
  return context.NavWindow->RootWindow;
}

/// Returns all panels that a key can enter, in the order in which it does.
std::vector<ImGuiWindow*> panels() {
  constexpr ImGuiWindowFlags kNoPanel = ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip |
                                        ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoNavInputs;
  std::vector<ImGuiWindow*> found;
  for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    const bool is_shown = window->Active && !window->Hidden && window->RootWindow == window;
    if (is_shown && (window->Flags & kNoPanel) == 0) found.push_back(window);
  }
  std::sort(found.begin(), found.end(), [](const ImGuiWindow* a, const ImGuiWindow* b) {
    return std::tie(a->Pos.y, a->Pos.x) < std::tie(b->Pos.y, b->Pos.x);
  });
  return found;
}

}  // namespace

bool is_popup_open() { return ImGui::GetCurrentContext()->OpenPopupStack.Size > 0; }

bool dialogue_has_keys() { return is_popup_open() || ImGui::GetIO().WantTextInput; }

bool panels_have_keys() { return dialogue_has_keys() || entered_panel() != nullptr; }

void enter_panel(int direction) {
  std::vector<ImGuiWindow*> order = panels();
  if (direction < 0) std::reverse(order.begin(), order.end());
  const auto present = std::find(order.begin(), order.end(), entered_panel());
  const auto next = present == order.end() ? order.begin() : present + 1;
  if (next == order.end()) {
    leave_panels();
  } else {
    enter(*next);
  }
}

void choose_first_item() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (entered_panel() != nullptr && context.NavId == 0) {
    ImGui::NavInitWindow(context.NavWindow, false);
  }
}

void leave_panels() {
  ImGui::FocusWindow(nullptr);
  ImGui::GetCurrentContext()->NavDisableHighlight = true;
}

bool close_menus() {
  if (!is_popup_open()) return false;
  ImGui::ClosePopupsExceptModals();
  return true;
}

void mark_entered_panel() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.NavWindow != nullptr && !context.NavWindow->RootWindow->Active) leave_panels();
  const ImGuiWindow* const panel = entered_panel();
  if (panel == nullptr || (panel->Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_MenuBar)) != 0)
    return;
  constexpr float kWidth = 2;
  ImGui::GetForegroundDrawList()->AddRect(
      panel->Pos, {panel->Pos.x + panel->Size.x, panel->Pos.y + panel->Size.y},
      ImGui::GetColorU32(ImGuiCol_NavHighlight), panel->WindowRounding, 0, kWidth);
}

void enter_menu_bar() {
  ImGuiWindow* const bar = ImGui::GetCurrentWindow();
  ImGui::FocusWindow(bar);
  ImGui::GetCurrentContext()->NavLayer = ImGuiNavLayer_Menu;
  enter(bar);
}

bool keys_walk_menu_bar() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return context.NavWindow != nullptr &&
         (context.NavWindow->Flags & ImGuiWindowFlags_MenuBar) != 0 &&
         context.NavLayer == ImGuiNavLayer_Menu;
}

bool is_come_to_menu() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return keys_walk_menu_bar() && !context.NavMoveSubmitted && !context.NavMoveForwardToNextFrame &&
         ImGui::IsItemFocused();
}

bool is_focus_moving() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const bool chooses_first = context.NavInitRequest && context.NavInitResultId != 0;
  const bool moves = context.NavMoveSubmitted || context.NavMoveForwardToNextFrame;
  const bool types_next = context.WantTextInputNextFrame != -1 &&
                          context.IO.WantTextInput != (context.WantTextInputNextFrame != 0);
  if (chooses_first || moves || types_next || context.NavNextActivateId != 0) return true;
  const bool opens = std::any_of(context.OpenPopupStack.begin(), context.OpenPopupStack.end(),
                                 [](const ImGuiPopupData& popup) { return !popup.Window; });
  return opens || std::any_of(context.Windows.begin(), context.Windows.end(),
                              [](const ImGuiWindow* any) { return any->Active && any->Hidden; });
}

}  // namespace window
