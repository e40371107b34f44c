// Statements at the top level of files that do not change are parsed once, and definitions there
// only as far as they are needed.
#include "syntax/parser.hpp"

namespace language {

void Parser::set_arena(Arena* arena) {
  arena_ = arena;
  lexer_.set_arena(arena);
}

/// Adds the statement that begins at the boundary to the scope, and goes on behind it, if it is
/// kept.
bool Parser::take_kept_statement(ScopeBuilder& scope) {
  const Place place = boundary();
  KeptFile* const file = program_.kept_file(place.file);
  const KeptStatement* const statement = file ? file->find(place.offset) : nullptr;
  if (!statement) return false;
  lexer_.go_on_at(statement->end);  // where an error would stand
  for (const TopLevelItem& item : statement->items) {
    if (const auto* assignment = std::get_if<Assignment>(&item)) {
      add(scope, *assignment);
    } else {
      std::visit([&](const auto& other) { scope.add(other); }, item);
    }
  }
  items_.clear();
  ahead_ = 0;
  return true;
}

/// Preparses the definition that begins with the next token, if it may be made later from its bytes
/// alone.
template <typename Definition>
Definition Parser::parse_top_definition(const ScopeBuilder& scope, Definition (Parser::*parse)()) {
  const Place begin = peek().place;
  // Behind the end of a file other messages are said.
  if (!scope.is_recorded() || !program_.kept_file(begin.file) || is_behind_file_)
    return (this->*parse)();
  Arena* const arena = arena_;
  set_arena(nullptr);
  try {
    Definition definition = (this->*parse)();
    set_arena(arena);
    definition.content = make(typename Definition::Content{{}, nullptr, arena});
    return definition;
  } catch (const NotPreparsed&) {
    set_arena(arena);
    lexer_.go_on_at(begin.offset);
    ahead_ = 0;
    return (this->*parse)();
  }
}

template FunctionDefinition Parser::parse_top_definition(const ScopeBuilder&,
                                                         FunctionDefinition (Parser::*)());
template ModuleDefinition Parser::parse_top_definition(const ScopeBuilder&,
                                                       ModuleDefinition (Parser::*)());

/// Parses the statement whose first token has been read, and keeps it if it may be kept.
void Parser::parse_top_statement(ScopeBuilder& scope) {
  const Place begin = tokens_[0].place;
  KeptFile* const file = program_.kept_file(begin.file);
  items_.clear();
  // Behind the end of a file nested scopes do not warn of assignments that are overwritten. An
  // error in a block stands within it.
  const bool is_block = tokens_[0].is('{');
  if (!file || file->is_complete || is_behind_file_ || is_block) return parse_statement(scope);
  const KeptStatement start{lexer_.blank_begin(), begin.offset, 0};
  const uint32_t entries = lexer_.entries();
  const size_t warnings = messages_.warnings() - warnings_of_top_level_;
  const uint32_t unsaid = unsaid_;
  set_arena(&file->arena());
  parse_statement(scope);
  set_arena(&program_.arena);
  const Place end = boundary();
  const bool is_silent = messages_.warnings() - warnings_of_top_level_ == warnings;
  const Place remark = lexer_.last_remark();
  const bool has_remark =
      remark.file == begin.file && remark.offset > begin.offset && remark.offset <= end.offset;
  if (!is_silent || has_remark || unsaid_ != unsaid || is_behind_file_ ||
      lexer_.entries() != entries)
    return;
  KeptStatement statement = start;
  statement.end = end.offset;
  file->add(statement, items_);
}

}  // namespace language
