#include "code/parameter_list.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace language {
bool is_dynamic_name(Name name, const NameTable& names) {
  return names.is_dynamic(name) && names.text(name) != "$children";
}

bool names_dynamic(std::span<const Argument> arguments, const NameTable& names) {
  return std::any_of(arguments.begin(), arguments.end(), [&](const Argument& argument) {
    return argument.name != kNoName && is_dynamic_name(argument.name, names);
  });
}

ParameterList::ParameterList(std::span<const Parameter> parameters, const NameTable& names,
                             const Dialect& dialect)
    : binds_dynamic_(dialect.has_arguments_first) {
  for (const Parameter& parameter : parameters) {
    Target target = target_of(parameter.name, names);
    if (target.is_dynamic) {
      targets.push_back(target);
      continue;
    }
    const bool is_first = target.slot == defaults.size();
    if (is_first) defaults.push_back(nullptr);
    if (is_first || dialect.takes_last_default) defaults[target.slot] = parameter.value;
    targets.push_back(target);
  }
  declared_slots = static_cast<uint32_t>(slot_names.size());
}

ParameterList::ParameterList(std::span<const Name> parameters, const NameTable& names) {
  for (const Name name : parameters) targets.push_back(target_of(name, names));
  defaults.resize(targets.size());
  declared_slots = static_cast<uint32_t>(slot_names.size());
}

Target ParameterList::target_of(Name name, const NameTable& names) {
  if (is_dynamic_name(name, names) && !binds_dynamic_) return {name, 0, true};
  return {name, slot_names.add(name), false};
}

bool ParameterList::declares(Name name) const {
  if (slot_names.find(name) < declared_slots) return true;
  return std::any_of(targets.begin(), targets.end(),
                     [&](const Target& target) { return target.name == name; });
}

namespace {

/// Returns the steps of the chosen arguments, by the names that they are chosen for.
std::vector<ArgumentPlan::Step> steps_of(const std::unordered_map<std::string, uint32_t>& chosen,
                                         ParameterList& parameters, const NameTable& names) {
  std::vector<ArgumentPlan::Step> steps;
  for (const auto& [text, number] : chosen)
    steps.push_back({number, parameters.target_of(names.find(text), names)});
  return steps;
}

/// Sorts steps as the arguments are written, and adds those of arguments that are not chosen.
void order_as_written(std::vector<ArgumentPlan::Step>& steps, size_t arguments) {
  std::vector<ArgumentPlan::Step> ordered(arguments);
  for (uint32_t number = 0; number < arguments; ++number) ordered[number] = {number, {}, true};
  for (const ArgumentPlan::Step& step : steps) ordered[step.argument] = step;
  steps = std::move(ordered);
}

}  // namespace

ArgumentPlan plan_arguments(std::span<const Argument> arguments, ParameterList& parameters,
                            size_t positional, Place call, const NameTable& names,
                            const Dialect& dialect, Name taken) {
  ArgumentPlan plan;
  // OpenSCAD 2021.01 gathers the arguments in such a table and evaluates them in its order, which
  // is therefore that of this library.
  std::unordered_map<std::string, uint32_t> chosen;
  const auto is_named = [&](const std::string& text) {
    const auto found = chosen.find(text);
    return found != chosen.end() && arguments[found->second].name != kNoName;
  };
  const auto text_of_parameter = [&](size_t number) {
    return std::string(names.text(parameters.targets[number].name));
  };
  const auto is_taken = [&](size_t number) {
    return parameters.targets[number].name == taken || is_named(text_of_parameter(number));
  };
  size_t position = 0;
  bool has_too_many = false;
  for (uint32_t number = 0; number < arguments.size(); ++number) {
    const Argument& argument = arguments[number];
    if (argument.name == kNoName) {
      if (dialect.fills_free_parameters)
        while (position < positional && is_taken(position)) ++position;
      if (position < positional) {
        chosen[text_of_parameter(position++)] = number;
      } else if (!has_too_many) {
        has_too_many = true;
        plan.warnings.push_back({"Too many unnamed arguments supplied", call, true});
      }
      continue;
    }
    std::string text(names.text(argument.name));
    if (!names.is_dynamic(argument.name) && !parameters.declares(argument.name))
      plan.warnings.push_back({filled(dialect.undeclared_argument, {text}), call, true});
    if (chosen.count(text)) {
      const std::string_view words =
          is_named(text) ? dialect.repeated_argument : dialect.overriding_argument;
      plan.warnings.push_back({filled(words, {text}), call, false});
    }
    chosen[std::move(text)] = number;
  }
  plan.steps = steps_of(chosen, parameters, names);
  if (dialect.has_arguments_first) order_as_written(plan.steps, arguments.size());
  return plan;
}

}  // namespace language
