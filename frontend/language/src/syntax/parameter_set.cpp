#include "syntax/parameter_set.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/read_file.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/parameter_text.hpp"

namespace language {

namespace {

using Json = nlohmann::json;

/// Returns a member of an object; null if there is none.
const Json* member(const Json* object, const std::string& name) {
  if (!object || !object->is_object()) return nullptr;
  const auto found = object->find(name);
  return found == object->end() ? nullptr : &*found;
}

void say_unreadable(Messages& messages, const std::string& file, const std::string& reason) {
  messages.say(MessageGroup::kError, "Cannot open Parameter Set '" + file + "': " + reason);
}

std::optional<Json> read_json(const std::string& file, Messages& messages) {
  const auto text = read_file(file);
  if (!text) {
    say_unreadable(messages, file, file + ": cannot open file");
    return std::nullopt;
  }
  try {
    return Json::parse(*text);
  } catch (const Json::parse_error& error) {
    const auto end = text->begin() + static_cast<long>(std::min(error.byte, text->size()));
    const auto line = 1 + std::count(text->begin(), end, '\n');
    say_unreadable(messages, file, file + "(" + std::to_string(line) + "): expected value");
    return std::nullopt;
  }
}

/// Numbers and words count as the texts that stand in the file.
std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

void apply_parameter_set(Program& program, Messages& messages, const std::string& file,
                         const std::string& set, const DefaultType& type_of) {
  if (file.empty() || set.empty() || !program.units[0].scope) return;
  const auto json = read_json(file, messages);
  const Json* values = member(member(json ? &*json : nullptr, "parameterSets"), set);
  if (!values) return;
  Scope scope = *program.units[0].scope;
  std::vector<Assignment> assignments(scope.assignments.begin(), scope.assignments.end());
  for (Assignment& assignment : assignments) {
    const Json* value = member(values, std::string(program.names.text(assignment.name)));
    if (!value || value->is_structured()) continue;
    const ValueType type = type_of(*assignment.value);
    const Expression* literal =
        parameter_literal(program.arena, assignment.place, text_of(*value), type);
    if (literal) {
      assignment.value = literal;
    } else if (type == ValueType::kBool) {  // where OpenSCAD goes no further
      messages.say(MessageGroup::kError,
                   "Cannot apply Parameter Set 'conversion of data to type \"b\" failed'");
      break;
    }
  }
  scope.assignments = copy_to_arena<Assignment>(program.arena, assignments);
  program.units[0].scope = new (program.arena.allocate(sizeof(Scope), alignof(Scope))) Scope(scope);
}

}  // namespace language
