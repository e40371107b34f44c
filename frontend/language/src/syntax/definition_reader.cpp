#include "syntax/definition_reader.hpp"

#include "syntax/parser.hpp"

namespace language {

template <typename Definition, typename Parse>
auto& DefinitionReader::content_of(const Definition& definition, Parse parse) {
  auto& content = *definition.content;
  if (!content.body) {
    NoFiles no_files;
    Lexer lexer(program_.files, program_.names, *content.arena, messages_, no_files,
                {definition.place.file, {}, false});
    lexer.go_on_at(definition.extent.begin);
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
