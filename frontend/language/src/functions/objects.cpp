// object(), has_key() and is_object().
#include <span>
#include <string>
#include <utility>

#include "functions/builtin_functions.hpp"
#include "values/members_object.hpp"

namespace language::functions {
namespace {

std::string in_brackets(const Value& value) {
  return "<" + std::string(type_name(value.type())) + ">";
}

/// Returns what is wrong with an entry of a list of members, [key, value] or [key], with its place
/// behind "object(" and the rest of the sentence; an empty text: nothing.
std::string problem_of(const Value& entry, const std::string& place) {
  constexpr const char* kHelp =
      " In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be "
      "<string>.";
  if (!entry.is_vector())
    return "object( " + place + " " + in_brackets(entry) + "] ) Entry type is not a list, it is " +
           in_brackets(entry) + "." + kHelp;
  const auto parts = entry.elements();
  if (parts.empty()) return "object(" + place + " []]) Entry is empty." + kHelp;
  if (parts.size() > 2)
    return "object(" + place + " [...]]) Entry length is " + std::to_string(parts.size()) +
           ", must be 1 [key] or 2 [key,value]." + kHelp;
  if (parts[0].is_string()) return {};
  return "object(" + place + " [" + in_brackets(parts[0]) + (parts.size() == 2 ? ",value" : "") +
         "]]) The key of the entry is not <string> but " + in_brackets(parts[0]) + "." + kHelp;
}

/// Returns what is wrong with an unnamed argument of object(); an empty text: nothing.
std::string problem_of_argument(const Value& argument, size_t number) {
  const std::string place = "Argument " + std::to_string(number);
  if (argument.is_object()) return {};
  if (!argument.is_vector())
    return "object(" + place + " " + in_brackets(argument) +
           ") An unnamed argument must be either <object> or <list>, it is " +
           in_brackets(argument) + ". ";
  const auto entries = argument.elements();
  for (size_t i = 0; i < entries.size(); ++i) {
    const Value& entry = entries[i];
    const bool is_right = entry.is_vector() && !entry.elements().empty() &&
                          entry.elements().size() <= 2 && entry.elements()[0].is_string();
    if (!is_right) return problem_of(entry, place + " [Element " + std::to_string(i));
  }
  return {};
}

/// Sets and removes members as a list says.
void apply_list(ObjectWriter& object, std::span<const Value> entries) {
  for (const Value& entry : entries) {
    const auto parts = entry.elements();
    if (parts.size() == 2) {
      object.set(parts[0], parts[1]);
    } else {
      object.remove(parts[0].text());
    }
  }
}

void copy_members(ObjectWriter& object, const MembersObject& from) {
  const auto members = from.keys_and_values();
  for (size_t i = 0; i < members.size(); i += 2) object.set(members[i], members[i + 1]);
}

}  // namespace

size_t next_of_object(const FunctionCall& call) {
  const size_t done = call.arguments.size();
  const bool is_wrong = done > 0 && call.names[done - 1].empty() &&
                        !problem_of_argument(call.arguments.back(), done - 1).empty();
  return is_wrong || done == call.written ? kNoArgument : done;
}

Value object(const FunctionCall& call) {
  ObjectWriter object;
  for (size_t i = 0; i < call.arguments.size(); ++i) {
    const Value& argument = call.arguments[i];
    if (!call.names[i].empty()) {
      object.set(call.names[i], argument);
      continue;
    }
    if (std::string problem = problem_of_argument(argument, i); !problem.empty()) {
      call.warn(std::move(problem));
      return Value::undef();
    }
    if (argument.is_object()) {
      copy_members(object, argument.members());
    } else {
      apply_list(object, argument.elements());
    }
  }
  return object.take();
}

Value has_key(const FunctionCall& call) {
  if (!call.arguments[0].is_object()) return not_converted(call, 0, "object");
  if (!call.arguments[1].is_string()) return not_converted(call, 1, "string");
  return Value::boolean(call.arguments[0].members().find(call.arguments[1].text()) != nullptr);
}

Value is_object(const FunctionCall& call) { return Value::boolean(call.arguments[0].is_object()); }

}  // namespace language::functions
