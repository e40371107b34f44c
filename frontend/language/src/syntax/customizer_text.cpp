// The parameters of a design as `openscad -o x.param` writes them.
#include <nlohmann/json.hpp>

#include "language/customizer.hpp"

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

nlohmann::json json_of(const CustomizerParameter& parameter) {
  nlohmann::json json = {{"name", parameter.name},
                         {"group", parameter.group.empty() ? "Parameters" : parameter.group},
                         {"type", type_of_json(parameter.value)},
                         {"initial", json_of(parameter.value)}};
  if (!parameter.description.empty()) json["caption"] = parameter.description;
  if (parameter.longest) json["maxLength"] = *parameter.longest;
  if (parameter.range) {
    json["min"] = parameter.range->min;
    json["max"] = parameter.range->max;
    json["step"] = parameter.range->step.value_or(1);
  }
  for (const ParameterChoice& choice : parameter.choices)
    json["options"].push_back({{"name", choice.label}, {"value", json_of(choice.value)}});
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
