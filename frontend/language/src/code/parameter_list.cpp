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

ParameterList::ParameterList(std::span<const Parameter> parameters, const NameTable& names) {
  for (const Parameter& parameter : parameters) {
    Target target = target_of(parameter.name, names);
    if (target.is_dynamic) {
      targets.push_back(target);
      continue;
    }
    if (target.slot == defaults.size()) defaults.push_back(nullptr);
    defaults[target.slot] = parameter.value;
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
  if (is_dynamic_name(name, names)) return {name, 0, true};
  return {name, slot_names.add(name), false};
}

bool ParameterList::declares(Name name) const {
  if (slot_names.find(name) < declared_slots) return true;
  return std::any_of(targets.begin(), targets.end(),
                     [&](const Target& target) { return target.name == name; });
}

ArgumentPlan plan_arguments(std::span<const Argument> arguments, ParameterList& parameters,
                            size_t positional, Place call, const NameTable& names) {
  ArgumentPlan plan;
  // OpenSCAD gathers the arguments in such a table and evaluates them in its order, which is
  // therefore that of this library.
  std::unordered_map<std::string, uint32_t> chosen;
  size_t position = 0;
  bool has_too_many = false;
  for (uint32_t number = 0; number < arguments.size(); ++number) {
    const Argument& argument = arguments[number];
    if (argument.name == kNoName) {
      if (position < positional) {
        chosen[std::string(names.text(parameters.targets[position++].name))] = number;
      } else if (!has_too_many) {
        has_too_many = true;
        plan.warnings.push_back({"Too many unnamed arguments supplied", call, true});
      }
      continue;
    }
    std::string text(names.text(argument.name));
    if (!names.is_dynamic(argument.name) && !parameters.declares(argument.name))
      plan.warnings.push_back({"variable " + text + " not specified as parameter", call, true});
    if (chosen.count(text))
      plan.warnings.push_back({"argument " + text + " supplied more than once", call, false});
    chosen[std::move(text)] = number;
  }
  for (const auto& [text, number] : chosen) {
    plan.steps.push_back({number, parameters.target_of(names.find(text), names)});
  }
  return plan;
}

}  // namespace language
