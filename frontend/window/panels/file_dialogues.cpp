#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "panels/panels.hpp"
#include "panels/style.hpp"

namespace window {
namespace {

constexpr const char* kOpenName = "Open a design";

// In lines of text.
constexpr float kMostLines = 14, kLeastLines = 2, kOtherLines = 9;
constexpr int kPage = 10;

/// Returns whether a key goes down in this frame, or repeats.
bool is_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

/// Takes the keys that choose an entry while the text is typed.
int on_text_key(ImGuiInputTextCallbackData* data) {
  FileBrowser& browser = *static_cast<FileBrowser*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) {
    browser.move(data->EventKey == ImGuiKey_UpArrow ? -1 : 1);
  } else {
    const std::string text = browser.completed();
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, text.c_str());
  }
  return 0;
}

/// Draws the text, which has the keys as long as the dialogue is open. Returns whether Enter was
/// pressed.
bool draw_text(FileBrowser& browser, float width) {
  const bool was_empty = browser.text().empty();
  std::string text = browser.text();
  const bool takes_keys = ImGui::IsWindowAppearing() || !ImGui::IsAnyItemActive();
  if (takes_keys && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(width);
  const bool is_entered = ImGui::InputTextWithHint("##text", "a part of the name, or a path", &text,
                                                   ImGuiInputTextFlags_EnterReturnsTrue |
                                                       ImGuiInputTextFlags_CallbackCompletion |
                                                       ImGuiInputTextFlags_CallbackHistory,
                                                   on_text_key, &browser);
  if (text != browser.text()) browser.type(text);
  if (is_pressed(ImGuiKey_PageUp)) browser.move(-kPage);
  if (is_pressed(ImGuiKey_PageDown)) browser.move(kPage);
  if (was_empty && is_pressed(ImGuiKey_Backspace)) browser.go_up();
  return is_entered;
}

/// Draws the entries. Returns whether one was double-clicked.
bool draw_entries(FileBrowser& browser, const ImVec2& size) {
  bool is_entered = false;
  if (ImGui::BeginChild("##entries", size, true, ImGuiWindowFlags_NoNav)) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(browser.entries().size()));
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float at = line * static_cast<float>(browser.chosen());
    const float low = ImGui::GetScrollY(), high = low + ImGui::GetWindowHeight() - 2 * line;
    if (!ImGui::IsWindowHovered() && (at < low || at > high)) {
      ImGui::SetScrollY(std::max(at - 0.5f * (high - low), 0.0f));
    }
    std::optional<std::size_t> clicked;
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const auto index = static_cast<std::size_t>(i);
        const FileBrowser::Entry& entry = browser.entries()[index];
        ImGui::PushID(i);
        const bool is_chosen = index == browser.chosen();
        if (ImGui::Selectable("##entry", is_chosen, ImGuiSelectableFlags_AllowDoubleClick)) {
          clicked = index;
        }
        ImGui::SameLine(ImGui::GetStyle().WindowPadding.x);
        ImGui::TextUnformatted((entry.name + (entry.is_folder ? "/" : "")).c_str());
        ImGui::PopID();
      }
    }
    if (clicked) browser.choose(*clicked);
    is_entered = clicked && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  }
  ImGui::EndChild();
  return is_entered;
}

/// Draws the dialogue's inside. Returns the path of the design that is chosen.
std::optional<std::string> draw_browser(FileBrowser& browser) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float width = std::min(34 * ImGui::GetFontSize(), 0.85f * display.x);
  ImGui::TextUnformatted(cut_to(browser.folder(), width).c_str());
  bool is_entered = draw_text(browser, width);
  const float lines = std::clamp(display.y / line - kOtherLines, kLeastLines, kMostLines);
  is_entered |= draw_entries(browser, {width, lines * line});
  ImGui::PushStyleColor(ImGuiCol_Text, kErrorColor);
  ImGui::TextUnformatted(cut_to(browser.problem(), width).c_str());
  ImGui::PopStyleColor();
  is_entered |= ImGui::Button("Open");
  return is_entered ? browser.enter() : std::nullopt;
}

/// What the dialogue for a kind of file says.
struct PathWords {
  const char* name;
  const char* formats;
  const char* save;
};

/// Ends the dialogue if the file may be written there, or asks first.
void save_or_ask(PathDialogue& dialogue, const SaveFile& save) {
  std::error_code failed;
  if (dialogue.path_to_overwrite != dialogue.path &&
      std::filesystem::exists(dialogue.path, failed)) {
    dialogue.path_to_overwrite = dialogue.path;
    return;
  }
  save(dialogue.path);
  ImGui::CloseCurrentPopup();
}

void path_row(PathDialogue& dialogue, const PathWords& words, const SaveFile& save, float width) {
  ImGui::SetNextItemWidth(width);
  const bool is_entered =
      ImGui::InputText("##path", &dialogue.path, ImGuiInputTextFlags_EnterReturnsTrue);
  if (is_entered) ImGui::SetKeyboardFocusHere(-1);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  const bool is_asking = dialogue.path_to_overwrite == dialogue.path;
  ImGui::TextUnformatted(is_asking ? "That file exists already." : words.formats);
  ImGui::PopTextWrapPos();
  // Return alone never overwrites: it may be pressed twice. The field may not have the keys again.
  const bool is_return = is_entered || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
  const bool is_confirmed = is_asking && is_return && ImGui::GetIO().KeyCtrl;
  const bool is_pressed = ImGui::Button(is_asking ? "Overwrite (Ctrl+Return)" : words.save);
  if (is_pressed || is_confirmed || (is_entered && !is_asking)) save_or_ask(dialogue, save);
}

void draw_path_dialogue(PathDialogue& dialogue, const PathWords& words, const SaveFile& save) {
  if (dialogue.is_asked_for) {
    dialogue.is_asked_for = false;
    dialogue.path_to_overwrite.clear();
    ImGui::OpenPopup(words.name);
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(words.name, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  path_row(dialogue, words, save, std::min(30 * ImGui::GetFontSize(), 0.8f * size.x));
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace

void draw_open_dialogue(State& state, const OpenDesign& open) {
  if (state.asks_for_design) {
    state.asks_for_design = false;
    const std::string folder = std::filesystem::path(state.name).parent_path().string();
    state.browser.emplace(folder);
    ImGui::OpenPopup(kOpenName);
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kOpenName, nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove)) {
    return;
  }
  const std::optional<std::string> path = draw_browser(*state.browser);
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel") || is_pressed(ImGuiKey_Escape);
  if (path || is_cancelled) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (path) open(*path);
}

void draw_save_dialogue(State& state, const SaveFile& save) {
  draw_path_dialogue(
      state.picture_dialogue,
      {"Save picture", ".png or .exr, as -o writes it, in the size of the window", "Save"}, save);
}

void draw_export_dialogue(State& state, const SaveFile& save) {
  draw_path_dialogue(
      state.model_dialogue,
      {"Export", "a solid: .stl, .off, .obj, .amf or .3mf; a plane figure: .svg, .dxf or .pdf",
       "Export"},
      save);
}

}  // namespace window
