#include "panels/save_dialogue.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

namespace window {
namespace {

/// Ends the dialogue if the picture may be written there, or asks first.
void save_or_ask(State& state, const SavePicture& save) {
  std::error_code failed;
  if (state.path_to_overwrite != state.picture_path &&
      std::filesystem::exists(state.picture_path, failed)) {
    state.path_to_overwrite = state.picture_path;
    return;
  }
  save(state.picture_path);
  ImGui::CloseCurrentPopup();
}

void path_row(State& state, const SavePicture& save, float width) {
  ImGui::SetNextItemWidth(width);
  const bool is_entered =
      ImGui::InputText("##path", &state.picture_path, ImGuiInputTextFlags_EnterReturnsTrue);
  if (is_entered) ImGui::SetKeyboardFocusHere(-1);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  const bool is_asking = state.path_to_overwrite == state.picture_path;
  ImGui::TextUnformatted(is_asking ? "That file exists already."
                                   : ".png or .exr, as -o writes it, in the size of the window");
  ImGui::PopTextWrapPos();
  // Return alone never overwrites: it may be pressed twice. The field may not have the keys again.
  const bool is_return = is_entered || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
  const bool is_confirmed = is_asking && is_return && ImGui::GetIO().KeyCtrl;
  const bool is_pressed = ImGui::Button(is_asking ? "Overwrite (Ctrl+Return)" : "Save");
  if (is_pressed || is_confirmed || (is_entered && !is_asking)) save_or_ask(state, save);
}

}  // namespace

void draw_save_dialogue(State& state, const SavePicture& save) {
  constexpr const char* kName = "Save picture";
  if (state.asks_for_path) {
    state.asks_for_path = false;
    state.path_to_overwrite.clear();
    ImGui::OpenPopup(kName);
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  path_row(state, save, std::min(30 * ImGui::GetFontSize(), 0.8f * size.x));
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace window
