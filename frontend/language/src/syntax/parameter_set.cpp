#include "syntax/parameter_set.hpp"

#include <vector>

#include "base/read_file.hpp"
#include "language/parameter_set_file.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/parameter_text.hpp"

namespace language {

namespace {

void say_unreadable(Messages& messages, const std::string& file, const std::string& reason) {
  messages.say(MessageGroup::kError, "Cannot open Parameter Set '" + file + "': " + reason);
}

}  // namespace

std::optional<ParameterSet> read_parameter_set(const std::string& file, const std::string& set,
                                               Messages& messages) {
  if (file.empty() || set.empty()) return std::nullopt;
  const auto text = read_file(file);
  if (!text) {
    say_unreadable(messages, file, file + ": cannot open file");
    return std::nullopt;
  }
  try {
    return ParameterSetFile(*text).find(set);
  } catch (const ParameterSetFile::ParseError& error) {
    say_unreadable(messages, file, file + "(" + std::to_string(error.line) + "): expected value");
    return std::nullopt;
  }
}

void apply_parameter_set(Program& program, Messages& messages, const ParameterSet& set,
                         const DefaultType& type_of) {
  if (!program.units[0].scope) return;
  Scope scope = *program.units[0].scope;
  std::vector<Assignment> assignments(scope.assignments.begin(), scope.assignments.end());
  for (Assignment& assignment : assignments) {
    const auto text = set.find(program.names.text(assignment.name));
    if (text == set.end()) continue;
    const ValueType type = type_of(*assignment.value);
    const Expression* literal =
        parameter_literal(program.arena, assignment.place, text->second, type);
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
