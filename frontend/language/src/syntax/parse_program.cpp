#include "syntax/parse_program.hpp"

#include <exception>

#include "base/evaluation_thread.hpp"
#include "syntax/parser.hpp"
#include "syntax/program_reader.hpp"

namespace language {

namespace {

ParseOutcome parse_here(Program& program, Messages& messages, const std::string& path,
                        const ParseOptions& options) {
  const auto say = [&](std::string line) { messages.say(MessageGroup::kPlain, std::move(line)); };
  ProgramReader reader(program, messages, options);
  if (!reader.read_main(path)) {
    say("Can't open input file '" + path + "'!");
    say("");
    return ParseOutcome::kUnreadable;
  }
  program.is_parsed = reader.parse_main();
  if (!program.is_parsed) {
    say("Can't parse file '" + (path == "-" ? "<stdin>" : path) + "'!");
    say("");
    return ParseOutcome::kNotParsed;
  }
  reader.parse_used();
  return ParseOutcome::kParsed;
}

}  // namespace

ParseOutcome parse_program(Program& program, Messages& messages, const std::string& path,
                           const ParseOptions& options) {
  ParseOutcome outcome{};
  with_deep_stack(program.dialect.most_symbols,
                  [&] { outcome = parse_here(program, messages, path, options); });
  return outcome;
}

template <typename Definition, typename Parse>
auto& DefinitionReader::content_of(const Definition& definition, Parse parse) {
  auto& content = *definition.content;
  if (!content.body) {
    NoFiles no_files;
    Lexer lexer(program_.dialect, program_.files, program_.names, *content.arena, messages_,
                no_files, {definition.place.file, {}, false});
    lexer.go_on_at(definition.begin);
    Parser parser(lexer, program_, messages_, stop_);
    content = *parse(parser).content;
  }
  return content;
}

const FunctionDefinition::Content& DefinitionReader::content_of(
    const FunctionDefinition& function) {
  return content_of(function, [](Parser& parser) { return parser.parse_function(); });
}

const ModuleDefinition::Content& DefinitionReader::content_of(const ModuleDefinition& module) {
  return content_of(module, [](Parser& parser) { return parser.parse_module(); });
}

}  // namespace language
