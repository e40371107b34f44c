#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "customizer.hpp"
#include "panels/panels.hpp"

namespace window {
namespace {

using language::CustomizerParameter;
using language::ParameterChoice;
using language::ParameterValue;

/// A drag over this many pixels is one step.
constexpr float kPixelsAStep = 6;

bool escapes() { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)); }

/// Returns whether what is being entered counts now, after the item was drawn; `is_live`: it also
/// counts while it is dragged.
bool is_entered(ParameterEdit& edit, const std::string& id, bool is_changed, bool is_live) {
  if (edit.id != id) return false;
  if (escapes()) {
    edit = {};
    return false;
  }
  return !ImGui::IsItemActive() || (is_changed && is_live);
}

/// Returns what a key makes of a number that ImGui has moved a little: the next step, or with shift
/// the tenth one.
double stepped(double before, double after, double step) {
  constexpr double kFast = 10;
  return before + std::copysign(ImGui::GetIO().KeyShift ? kFast * step : step, after - before);
}

/// Draws a number, as wide as the next item is set to be.
std::optional<double> number_control(const std::string& id, const NumberGrid& grid, double value,
                                     ParameterEdit& edit) {
  const double before = edit.id == id ? edit.number : value;
  double number = before;
  const bool is_typed = edit.id == id && ImGui::GetIO().WantTextInput;
  const double shown = edit.id == id && !is_typed ? grid.snap(number) : number;
  // Without a %, ImGui shows the text, and does not round the number to it.
  const std::string text = language::set_text(shown);
  bool is_changed = false;
  if (const auto& range = grid.range()) {
    is_changed = ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &number, &range->min,
                                     &range->max, text.c_str(), ImGuiSliderFlags_AlwaysClamp);
  } else {
    is_changed = ImGui::DragScalar(id.c_str(), ImGuiDataType_Double, &number,
                                   static_cast<float>(grid.step()) / kPixelsAStep, nullptr, nullptr,
                                   text.c_str());
  }
  const bool types = ImGui::GetIO().WantTextInput;
  const bool drags = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (is_changed && !types && !drags) number = stepped(before, number, grid.step());
  if (is_changed) edit = {id, number, types};
  if (!is_entered(edit, id, is_changed, !types)) return std::nullopt;
  const double entered = edit.is_typed ? grid.clamp(edit.number) : grid.snap(edit.number);
  if (!ImGui::IsItemActive()) edit = {};
  return entered;
}

std::optional<ParameterValue> numbers_control(const CustomizerParameter& parameter,
                                              const ParameterValue& value, ParameterEdit& edit) {
  if (const auto* number = std::get_if<double>(&value)) {
    const NumberGrid grid(parameter, std::get<double>(parameter.value));
    ImGui::SetNextItemWidth(-1);
    return number_control("##" + parameter.name, grid, *number, edit);
  }
  std::vector<double> numbers = std::get<std::vector<double>>(value);
  const auto& fallbacks = std::get<std::vector<double>>(parameter.value);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const auto count = static_cast<float>(numbers.size());
  const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
  bool is_changed = false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const NumberGrid grid(parameter, fallbacks[std::min(i, fallbacks.size() - 1)]);
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(std::max(width, 1.0f));
    const std::string id = "##" + parameter.name + std::to_string(i);
    const auto number = number_control(id, grid, numbers[i], edit);
    is_changed = is_changed || number;
    if (number) numbers[i] = *number;
  }
  return is_changed ? std::optional<ParameterValue>(numbers) : std::nullopt;
}

std::optional<ParameterValue> choice_control(const CustomizerParameter& parameter,
                                             const ParameterValue& value) {
  const auto chosen =
      std::find_if(parameter.choices.begin(), parameter.choices.end(),
                   [&](const ParameterChoice& choice) { return choice.value == value; });
  const std::string preview =
      chosen == parameter.choices.end() ? language::set_text(value) : chosen->label;
  std::optional<ParameterValue> result;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo(("##" + parameter.name).c_str(), preview.c_str())) return result;
  for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
    const ParameterChoice& choice = parameter.choices[i];
    const std::string label = choice.label + "##" + std::to_string(i);
    if (ImGui::Selectable(label.c_str(), choice.value == value)) result = choice.value;
  }
  ImGui::EndCombo();
  return result;
}

/// Cuts a text to a number of characters.
std::string shortened(std::string text, uint32_t longest) {
  std::size_t end = 0;
  for (uint32_t count = 0; end < text.size() && count < longest; ++count) {
    do {
      ++end;
    } while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
  }
  text.resize(end);
  return text;
}

std::optional<ParameterValue> text_control(const CustomizerParameter& parameter,
                                           const ParameterValue& value, ParameterEdit& edit) {
  const std::string id = "##" + parameter.name;
  std::string text = edit.id == id ? edit.text : language::set_text(value);
  ImGui::SetNextItemWidth(-1);
  const bool is_changed = ImGui::InputText(id.c_str(), &text);
  if (is_changed) edit = {id, 0, true, text};
  if (!is_entered(edit, id, is_changed, false)) return std::nullopt;
  const std::string entered =
      parameter.longest ? shortened(edit.text, *parameter.longest) : edit.text;
  edit = {};
  return language::value_of_text(entered, parameter.value);
}

}  // namespace

std::optional<ParameterValue> draw_parameter_control(const CustomizerParameter& parameter,
                                                     const ParameterValue& value,
                                                     ParameterEdit& edit) {
  if (!parameter.choices.empty()) return choice_control(parameter, value);
  if (const auto* boolean = std::get_if<bool>(&value)) {
    bool is_on = *boolean;
    const bool is_changed = ImGui::Checkbox(("##" + parameter.name).c_str(), &is_on);
    return is_changed ? std::optional<ParameterValue>(is_on) : std::nullopt;
  }
  const bool is_numeric =
      std::holds_alternative<double>(value) || std::holds_alternative<std::vector<double>>(value);
  if (is_numeric && value.index() == parameter.value.index()) {
    return numbers_control(parameter, value, edit);
  }
  return text_control(parameter, value, edit);
}

}  // namespace window
