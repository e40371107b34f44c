// The parameters of a design as `openscad -o x.param` writes them.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/number_text.hpp"
#include "language/customizer.hpp"
#include "syntax/parameter_comments.hpp"
#include "syntax/parameter_set.hpp"

namespace language {
namespace {

/// Returns a value; null of a vector or a range that is not set number by number.
nlohmann::json json_of(const ParameterValue& value) {
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return *numbers;
  return nullptr;
}

const char* type_of_json(const ParameterValue& value) {
  if (std::holds_alternative<bool>(value)) return "boolean";
  return std::holds_alternative<std::string>(value) ? "string" : "number";
}

/// Adds a range. A default outside of `[min:max]` widens it; `[max]` begins at 0 in any case.
void add_range(nlohmann::json& json, const CommentEntry& entry, const ParameterValue& value) {
  if (entry.size() > 3) return;
  const double first = *signed_number(entry.front()), last = *signed_number(entry.back());
  double min = entry.size() > 1 ? first : 0, max = last;
  const auto widen = [&](double number) {
    if (entry.size() > 1) min = std::min(min, number);
    max = std::max(max, number);
  };
  if (const auto* number = std::get_if<double>(&value)) {
    widen(*number);
  } else {
    for (const double one : std::get<std::vector<double>>(value)) widen(one);
  }
  json["min"] = min;
  json["max"] = max;
  json["step"] = entry.size() > 2 ? *signed_number(entry[1]) : 1.0;
}

/// Adds choices, each a number if it is one, whatever the default is. A default that is none of
/// them is the first.
void add_choices(nlohmann::json& json, const std::vector<CommentEntry>& entries,
                 const ParameterValue& value) {
  const nlohmann::json initial = json_of(value);
  nlohmann::json options = nlohmann::json::array();
  bool has_initial = false;
  for (const CommentEntry& entry : entries) {
    if (entry.size() > 2) return;
    const auto number = signed_number(entry.front());
    nlohmann::json choice;
    if (number) {
      choice = *number;
    } else {
      choice = *plain_words(entry.front());
    }
    has_initial = has_initial || choice == initial;
    options.push_back({{"name", *plain_words(entry.back())}, {"value", choice}});
  }
  if (options.empty()) return;
  if (!has_initial) {
    std::string name;
    if (const auto* number = std::get_if<double>(&value)) {
      append_general_number(name, *number);
    } else {
      name = std::get<std::string>(value);
    }
    const nlohmann::json first = {{"name", name}, {"value", initial}};
    options.insert(options.begin(), first);
  }
  json["options"] = std::move(options);
}

/// Adds what a parameter's comment says.
void add_comment(nlohmann::json& json, const CustomizerParameter& parameter) {
  const bool is_number = std::holds_alternative<double>(parameter.value);
  const bool is_text = std::holds_alternative<std::string>(parameter.value);
  if (const auto length = signed_number(parameter.comment)) {
    constexpr double kMost = std::numeric_limits<uint32_t>::max();
    if (is_text) json["maxLength"] = static_cast<uint32_t>(std::clamp(*length, 0.0, kMost));
    return;
  }
  const std::vector<CommentEntry> entries = comment_entries(parameter.comment);
  if (are_range(entries)) {
    if (is_number || std::holds_alternative<std::vector<double>>(parameter.value))
      add_range(json, entries.front(), parameter.value);
  } else if (is_number || is_text) {
    add_choices(json, entries, parameter.value);
  }
}

nlohmann::json json_of(const CustomizerParameter& parameter) {
  nlohmann::json json = {{"name", parameter.name},
                         {"group", parameter.group.empty() ? "Parameters" : parameter.group},
                         {"type", type_of_json(parameter.value)},
                         {"initial", json_of(parameter.value)}};
  if (!parameter.description.empty()) json["caption"] = parameter.description;
  add_comment(json, parameter);
  return json;
}

}  // namespace

std::string parameters_text(std::span<const CustomizerParameter> parameters,
                            std::string_view title) {
  nlohmann::json json = {{"title", title}};
  for (const CustomizerParameter& parameter : parameters) {
    const bool is_literal = std::holds_alternative<LiteralText>(parameter.value);
    if (!parameter.is_hidden() && !is_literal) json["parameters"].push_back(json_of(parameter));
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace language
