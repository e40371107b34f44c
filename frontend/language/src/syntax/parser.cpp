// Tokens and statements. Expressions are in parser_expressions.cpp.
#include "syntax/parser.hpp"

#include "language/stopped.hpp"

namespace language {

void Parser::fetch(Token& token) {
  constexpr uint32_t kTokensBetweenChecks = 4096;
  if (++taken_ % kTokensBetweenChecks == 0) check_stop();
  ++ahead_;
  lexer_.next(token);
}

void Parser::check_stop() const {
  if (stop_.stop_requested()) throw Stopped();
}

Name Parser::take_name() {
  const Name name = peek().name;
  consume();
  return name;
}

Name Parser::expect_name() {
  if (!peek().is(TokenKind::kName)) fail_at_token();
  return take_name();
}

const Scope* Parser::parse_file() {
  ScopeBuilder scope(scopes_, &items_);
  for (;;) {
    if (take_kept_statement(scope)) continue;
    if (peek().is(TokenKind::kEnd)) break;
    if (peek().is(TokenKind::kUse)) {
      consume();                               // the lexer has looked the file up
    } else if (!take_kept_statement(scope)) {  // of a file that peek() has entered
      parse_top_statement(scope);
    }
  }
  return make(scope);
}

void Parser::parse_statement(ScopeBuilder& scope) {
  switch (peek().kind) {
    case TokenKind::kModule:
      return scope.add(parse_top_definition(scope, &Parser::parse_module));
    case TokenKind::kFunction:
      return scope.add(parse_top_definition(scope, &Parser::parse_function));
    case TokenKind::kFileEnd:
      is_behind_file_ = true;
      return consume();
    case TokenKind::kName:
      if (peek_second().is('=')) return parse_assignment(scope);
      return parse_call(scope);
    case TokenKind::kSemicolon:
      return consume();
    case TokenKind::kOpenBrace:
      return parse_block(scope);
    default:
      return parse_call(scope);
  }
}

/// A block outside of child blocks makes no scope.
void Parser::parse_block(ScopeBuilder& scope) {
  const Nested nested(*this, 1);
  expect('{');
  while (!accept('}')) parse_statement(scope);
}

void Parser::parse_assignment(ScopeBuilder& scope) {
  const Place place = peek().place;
  const Name name = expect_name();
  expect('=');
  const Expression* value = parse_expression();
  expect(';');
  add(scope, {name, value, place});
}

void Parser::add(ScopeBuilder& scope, const Assignment& assignment) {
  const auto overwritten = scope.add(assignment);
  if (!overwritten || is_behind_file_) return;
  const Place first =
      program_.dialect.tells_first_assignment ? overwritten->first : overwritten->place;
  if (is_preparsing()) throw NotPreparsed();
  const size_t before = messages_.warnings();
  const bool is_said = say_overwritten(assignment, first);
  if (scope.is_recorded()) {
    warnings_of_top_level_ += messages_.warnings() - before;
  } else if (!is_said) {
    ++unsaid_;
  }
}

/// Returns whether it says anything. That depends on which file is the main one.
bool Parser::say_overwritten(const Assignment& assignment, Place first) {
  const Place second = assignment.place;
  // OpenSCAD knows the main file by its path as it is, and others by the path that it shows.
  const auto path = [&](FileId file) { return messages_.shown_path(file, PathBase::kMainFile); };
  const auto is_main = [&](Place place) {
    return files_[place.file].path == files_[messages_.main_file()].path;
  };
  const uint32_t line = files_.message_line(first);
  std::string of_file;
  if (!is_main(first) || !is_main(second)) {
    const bool is_same = path(first.file) == path(second.file);
    if (is_same ? line == files_.message_line(second) : !is_main(first)) return false;
    of_file = " of \"" + path(first.file) + "\"";
  }
  const std::string text = filled(program_.dialect.overwritten,
                                  {names_.text(assignment.name), std::to_string(line), of_file});
  messages_.warn(text, second);
  lexer_.check_warnings();
  return true;
}

ModuleDefinition Parser::parse_module() {
  const Nested nested(*this, 7);
  const Place begin = peek().place;
  consume();
  const Name name = expect_name();
  expect('(');
  const auto parameters = parse_parameters();
  const Place place = expect(')');
  const Scope* const body = parse_module_body();
  ModuleDefinition::Content* const content = make(ModuleDefinition::Content{parameters, body});
  return {name, place, content, begin.offset};
}

const Scope* Parser::parse_module_body() {
  ScopeBuilder body(scopes_);
  parse_statement(body);
  return make(body);
}

FunctionDefinition Parser::parse_function() {
  const Place begin = peek().place;
  consume();
  const Place place = peek().place;
  const Name name = expect_name();
  expect('(');
  const auto parameters = parse_parameters();
  expect(')');
  expect('=');
  const Expression* body = parse_expression();
  expect(';');
  FunctionDefinition::Content* const content = make(FunctionDefinition::Content{parameters, body});
  return {name, place, content, begin.offset};
}

void Parser::parse_call(ScopeBuilder& scope) {
  bool is_disabled = false;
  const ModuleCall call = parse_modified_call(is_disabled);
  if (!is_disabled) scope.add(call);
}

ModuleCall Parser::parse_modified_call(bool& is_disabled) {
  const auto modified = [&](uint8_t modifier) {
    const Nested nested(*this, 1);
    consume();
    ModuleCall call = parse_modified_call(is_disabled);
    call.modifiers |= modifier;
    return call;
  };
  switch (peek().kind) {
    case TokenKind::kExclamation:
      return modified(kRootModifier);
    case TokenKind::kHash:
      return modified(kHighlightModifier);
    case TokenKind::kPercent:
      return modified(kBackgroundModifier);
    case TokenKind::kStar:
      is_disabled = true;
      return modified(0);
    case TokenKind::kIf:
      return parse_if();
    default:
      return parse_plain_call();
  }
}

ModuleCall Parser::parse_if() {
  const Nested nested(*this, 5);
  ModuleCall call{};
  call.name = kNoName;
  consume();
  expect('(');
  call.condition = parse_expression();
  call.place = expect(')');
  call.children = parse_children();
  if (peek().is(TokenKind::kElse)) {
    consume();
    call.else_children = parse_children();
  }
  return call;
}

ModuleCall Parser::parse_plain_call() {
  const Nested nested(*this, 2);
  if (!begins_call()) fail_at_token();
  ModuleCall call{};
  call.place = peek().place;
  call.name = take_name();
  expect('(');
  call.arguments = parse_arguments();
  expect(')');
  call.children = parse_children();
  return call;
}

/// Some reserved words name modules, too.
bool Parser::begins_call() {
  switch (peek().kind) {
    case TokenKind::kName:
    case TokenKind::kLet:
    case TokenKind::kAssert:
    case TokenKind::kEcho:
    case TokenKind::kFor:
    case TokenKind::kEach:
      return true;
    default:
      return false;
  }
}

const Scope* Parser::parse_children() {
  static constexpr Scope kNoChildren;
  if (accept(';')) return &kNoChildren;
  ScopeBuilder scope(scopes_);
  if (peek().is('{')) {
    parse_child_statement(scope);
  } else {
    parse_call(scope);
  }
  return make(scope);
}

void Parser::parse_child_statement(ScopeBuilder& scope) {
  if (accept(';')) return;
  if (peek().is('{')) {
    const Nested nested(*this, 2);
    consume();
    while (!accept('}')) parse_child_statement(scope);
  } else if (peek().is(TokenKind::kName) && peek_second().is('=')) {
    parse_assignment(scope);
  } else {
    parse_call(scope);
  }
}

}  // namespace language
