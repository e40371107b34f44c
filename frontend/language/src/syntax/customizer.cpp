#include "language/customizer.hpp"

#include "base/with_deep_stack.hpp"
#include "messages/messages.hpp"
#include "syntax/parameter_annotation.hpp"
#include "syntax/parameter_comments.hpp"
#include "syntax/parameter_value.hpp"
#include "syntax/parser.hpp"
#include "syntax/program.hpp"

namespace language {

namespace {

/// Parses a text into an empty program. Returns null if it has a syntax error.
const Scope* parse_alone(Program& program, std::string_view text) {
  const FileId file = program.files.add({}, std::string(text.substr(0, text.find('\0'))));
  program.units.emplace_back().file = file;
  Messages messages(program.files, [](const Message&) {});
  messages.set_main_file(file, {});
  NoFiles no_files;
  Lexer lexer(program.files, program.names, program.arena, messages, no_files, {file, {}, false});
  Parser parser(lexer, program, messages, {});
  try {
    return parser.parse_file();
  } catch (const SyntaxError&) {
    return nullptr;
  }
}

}  // namespace

std::optional<std::vector<CustomizerParameter>> customizer_parameters(std::string_view text) {
  Program program;
  const Scope* scope = nullptr;
  with_deep_stack([&] { scope = parse_alone(program, text); });
  if (!scope) return std::nullopt;
  const ParameterComments comments(text);
  std::vector<CustomizerParameter> parameters;
  for (const Assignment& assignment : scope->assignments) {
    const uint32_t offset = assignment.place.offset;
    if (!comments.may_be_parameter(offset)) continue;
    auto value = literal_value(*assignment.value);
    if (!value) continue;
    CustomizerParameter& parameter = parameters.emplace_back();
    parameter.name = program.names.text(assignment.name);
    parameter.description = comments.description(offset);
    parameter.group = comments.group(offset);
    parameter.value = std::move(*value);
    parameter.offset = offset;
    annotate(parameter, comments.annotation(offset));
  }
  return parameters;
}

}  // namespace language
