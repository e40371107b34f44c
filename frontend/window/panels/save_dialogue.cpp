#include "panels/save_dialogue.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace window {

void draw_save_dialogue(State& state, const SavePicture& save) {
  constexpr const char* kName = "Save picture";
  if (state.asks_for_path) {
    state.asks_for_path = false;
    ImGui::OpenPopup(kName);
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const float width = std::min(30 * ImGui::GetFontSize(), 0.8f * size.x);
  ImGui::SetNextItemWidth(width);
  const bool entered =
      ImGui::InputText("##path", &state.picture_path, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  ImGui::TextUnformatted(".png or .exr, as -o writes it, in the size of the window");
  ImGui::PopTextWrapPos();
  if (entered || ImGui::Button("Save")) {
    save(state.picture_path);
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace window
