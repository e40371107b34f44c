#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

#include "panels/panels.hpp"
#include "panels/style.hpp"

namespace window {
namespace {

using Parameter = Customizer::Parameter;

/// The least width beside the section's panel, in heights of the font.
constexpr float kLeastBeside = 13;

constexpr const char* kNewSet = "Save as";
constexpr const char* kDeleteSet = "Delete";

void tell(State& state, const std::string& problem, const std::string& done) {
  state.notice = problem.empty() ? done : problem;
}

void save(State& state, const std::string& set) {
  if (set.empty()) return;
  tell(state, state.customizer.save(set), "saved \"" + set + "\" in " + state.customizer.file());
  ImGui::CloseCurrentPopup();
}

void new_set_popup(State& state) {
  if (!ImGui::BeginPopup(kNewSet)) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(12 * ImGui::GetFontSize());
  const bool is_entered =
      ImGui::InputText("##name", &state.new_set, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if (ImGui::Button("Save") || is_entered) save(state, state.new_set);
  ImGui::TextDisabled("in %s", state.customizer.file().c_str());
  ImGui::EndPopup();
}

void delete_popup(State& state) {
  if (!ImGui::BeginPopup(kDeleteSet)) return;
  const std::string set = state.customizer.set_name();
  ImGui::Text("Delete the set \"%s\"?", set.c_str());
  if (ImGui::Button("Delete")) {
    tell(state, state.customizer.erase(set), "deleted \"" + set + "\"");
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void set_list(State& state) {
  Customizer& customizer = state.customizer;
  std::string name = customizer.set_name().empty() ? "defaults" : customizer.set_name();
  if (customizer.is_set_changed()) name += ", changed";
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##set", name.c_str())) return;
  if (ImGui::IsWindowAppearing()) tell(state, customizer.read_sets(), "");
  std::optional<std::string> chosen;
  if (ImGui::Selectable("defaults", customizer.set_name().empty())) chosen = "";
  for (const std::string& set : customizer.set_names()) {
    const std::string label = set + "##set";
    if (ImGui::Selectable(label.c_str(), set == customizer.set_name())) chosen = set;
  }
  if (chosen) tell(state, customizer.choose(*chosen), "");
  ImGui::EndCombo();
}

/// Draws a button behind the last item, or below it where there is no room.
bool button_in_row(const char* label) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x;
  const float end = ImGui::GetItemRectMax().x + style.ItemInnerSpacing.x + width;
  if (end <= ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) {
    ImGui::SameLine(0, style.ItemInnerSpacing.x);
  }
  return ImGui::SmallButton(label);
}

void set_row(State& state) {
  Customizer& customizer = state.customizer;
  set_list(state);
  const bool has_set = !customizer.set_name().empty();
  if (has_set && customizer.is_set_changed() && button_in_row("Save")) {
    save(state, customizer.set_name());
  }
  if (button_in_row(kNewSet)) {
    state.new_set = customizer.set_name();
    ImGui::OpenPopup(kNewSet);
  }
  if (has_set && button_in_row(kDeleteSet)) ImGui::OpenPopup(kDeleteSet);
  if (customizer.is_any_changed() && button_in_row("Reset")) customizer.reset_all();
  new_set_popup(state);
  delete_popup(state);
}

/// Draws the name, and a button that resets the value if it is not the default.
void name_row(Customizer& customizer, std::size_t index) {
  const Parameter& parameter = customizer.parameters()[index];
  const bool is_changed = customizer.is_changed(index);
  ImGui::PushStyleColor(ImGuiCol_Text, is_changed ? kWarningColor : kTextColor);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = text_width("reset") + 2 * style.FramePadding.x;
  const float end = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  ImGui::PushTextWrapPos(is_changed ? end - width - style.ItemSpacing.x : end);
  ImGui::TextUnformatted(parameter.name.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  if (!is_changed) return;
  ImGui::SameLine(end - width);
  if (ImGui::SmallButton("reset")) customizer.reset(index);
}

void describe(const Parameter& parameter) {
  if (parameter.description.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", parameter.description.c_str());
  ImGui::PopStyleColor();
}

void draw_parameter(State& state, std::size_t index) {
  Customizer& customizer = state.customizer;
  const Parameter parameter = customizer.parameters()[index];  // name_row() may change them
  ImGui::PushID(parameter.name.c_str());
  const bool is_switch = std::holds_alternative<bool>(parameter.value);
  if (!is_switch) name_row(customizer, index);
  if (!is_switch) describe(parameter);
  const auto value =
      draw_parameter_control(parameter, customizer.value(index), state.parameter_edit);
  if (is_switch) {
    ImGui::SameLine();
    name_row(customizer, index);
    describe(parameter);
  }
  if (value) customizer.set(index, *value);
  ImGui::PopID();
}

/// Draws all parameters, each group under its name, which folds it.
void draw_groups(State& state) {
  const std::vector<Parameter>& parameters = state.customizer.parameters();
  const bool has_groups =
      !parameters.front().group.empty() || parameters.front().group != parameters.back().group;
  bool is_open = true;
  for (std::size_t i = 0; i < state.customizer.parameters().size(); ++i) {
    const std::string& group = parameters[i].group;
    if (has_groups && (i == 0 || group != parameters[i - 1].group)) {
      const float room = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetFrameHeight();
      const std::string name =
          group.empty() ? "Parameters##none" : cut_to(group, room) + "###" + group;
      is_open = ImGui::CollapsingHeader(name.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    }
    if (is_open) draw_parameter(state, i);
  }
}

bool is_shown(const State& state) {
  return state.shows_parameters && !state.customizer.parameters().empty();
}

}  // namespace

float customizer_right(const State& state, const SectionCorner& section) {
  if (!is_shown(state)) return 0;
  const float font = ImGui::GetFontSize(), beside = section.left - 2 * kPanelMargin;
  const float most =
      beside >= kLeastBeside * font ? beside : ImGui::GetIO().DisplaySize.x - 2 * kPanelMargin;
  return kPanelMargin + std::min(18 * font, most);
}

void draw_customizer(State& state, float bottom, const SectionCorner& section) {
  if (!is_shown(state)) return;
  const float right = customizer_right(state, section), width = right - kPanelMargin;
  const float least = 4 * ImGui::GetFrameHeight();
  float top = ImGui::GetFrameHeight() + kPanelMargin;
  const bool has_room_below = section.bottom + 2 * kPanelMargin + least <= bottom;
  if (right >= section.left && has_room_below) top = section.bottom + kPanelMargin;
  const float height = std::max(bottom - kPanelMargin - top, least);
  ImGui::SetNextWindowPos({kPanelMargin, top});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, height});
  ImGui::SetNextWindowBgAlpha(0.9f);
  if (ImGui::Begin("Parameters##customizer", &state.shows_parameters,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoFocusOnAppearing)) {
    set_row(state);
    draw_groups(state);
  }
  ImGui::End();
}

}  // namespace window
