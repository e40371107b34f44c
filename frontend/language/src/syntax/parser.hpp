// Makes syntax trees of tokens (LANGUAGE.md, "Grammar").
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "syntax/arena.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/lexer.hpp"
#include "syntax/program.hpp"
#include "syntax/scope_builder.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Parses one file with all that it includes. Throws SyntaxError after the message about it.
///
/// Definitions at the top level of kept files are preparsed, as V8 does with JavaScript's functions
/// (https://v8.dev/blog/preparser): their syntax is checked, and no tree is made.
class Parser {
 public:
  /// Syntax trees are made in the lexer's arena, or in those of kept files.
  Parser(Lexer& lexer, Program& program, Messages& messages, std::stop_token stop)
      : lexer_(lexer),
        program_(program),
        files_(program.files),
        names_(program.names),
        arena_(lexer.arena()),
        messages_(messages),
        stop_(std::move(stop)) {}

  const Scope* parse_file();
  /// Parse a definition that begins at the lexer's position.
  FunctionDefinition parse_function();
  ModuleDefinition parse_module();

 private:
  class Nested;
  struct Element {
    const Expression* node;
    bool is_comprehension;
  };

  // Tokens.
  const Token& peek() {
    if (ahead_ == 0) fetch(tokens_[0]);
    return tokens_[0];
  }
  const Token& peek_second() {
    peek();
    if (ahead_ == 1) fetch(tokens_[1]);
    return tokens_[1];
  }
  void fetch(Token& token);
  void check_stop() const;
  /// Removes the token that peek() has returned. The next one is not read before it is needed:
  /// reading may include a file, and say that it is missing.
  void consume() {
    if (--ahead_ > 0) tokens_[0] = tokens_[1];
  }
  /// Consumes a token of any kind, and returns its place.
  Place take_place() {
    const Place place = peek().place;
    consume();
    return place;
  }
  /// Consumes a sign, and returns its place.
  Place expect(char sign) {
    if (!peek().is(sign)) fail_at_token();
    return take_place();
  }
  Name take_name();
  Name expect_name();
  bool accept(char sign) {
    if (!peek().is(sign)) return false;
    consume();
    return true;
  }
  /// Consumes a comma, or several where they may be doubled. Returns how many.
  int accept_commas() {
    int count = 0;
    while (accept(',')) {
      ++count;
      if (!program_.dialect.has_doubled_commas) break;
    }
    return count;
  }
  /// Consumes commas before a list, if it may have some.
  int accept_leading_commas() { return program_.dialect.has_doubled_commas ? accept_commas() : 0; }
  [[noreturn]] void fail_at_token() const { lexer_.fail("syntax error"); }

  // The top level: kept_statements.cpp.
  Place boundary() const { return ahead_ > 0 ? tokens_[0].place : lexer_.position(); }
  bool take_kept_statement(ScopeBuilder& scope);
  void parse_top_statement(ScopeBuilder& scope);
  void set_arena(Arena* arena);
  template <typename Definition>
  Definition parse_top_definition(const ScopeBuilder& scope, Definition (Parser::*parse)());

  // Statements.
  void parse_statement(ScopeBuilder& scope);
  void parse_block(ScopeBuilder& scope);
  void parse_assignment(ScopeBuilder& scope);
  void add(ScopeBuilder& scope, const Assignment& assignment);
  const Scope* parse_module_body();
  void parse_call(ScopeBuilder& scope);
  ModuleCall parse_modified_call(bool& is_disabled);
  ModuleCall parse_if();
  ModuleCall parse_plain_call();
  const Scope* parse_children();
  void parse_child_statement(ScopeBuilder& scope);
  bool say_overwritten(const Assignment& assignment, Place first);
  bool begins_call();

  // Expressions.
  const Expression* parse_expression();
  const Expression* parse_operators(const Expression* left, Place start);
  const Expression* parse_conditional(const Expression* condition, Place start);
  const Expression* parse_binary(const Expression* left, Place start, int least_level);
  const Expression* parse_unary();
  const Expression* parse_power(const Expression* base, Place start);
  const Expression* parse_prefixed(UnaryOperator op);
  const Expression* parse_postfix(const Expression* operand, Place start);
  const Expression* parse_primary();
  const Expression* parse_index(const Expression* container, Place start);
  const Expression* parse_function_literal();
  const Expression* parse_body_expression(ExpressionKind kind);
  const Expression* parse_bracket();
  const Expression* parse_range(const Expression* begin, Place start);
  const Expression* parse_vector(const Element& first, Place start);
  Element parse_element(bool may_be_parenthesised);
  Element parse_parenthesised_element();
  Element parse_let_element();
  const Expression* parse_for();
  const Expression* make_for(std::span<const Argument> variables, const Expression* body,
                             Place place);
  const Expression* parse_if_element();
  bool begins_expression();

  // Lists in parentheses.
  std::span<const Argument> parse_arguments();
  Argument parse_argument();
  std::span<const Parameter> parse_parameters();
  Parameter parse_parameter();

  bool is_preparsing() const { return !arena_; }

  template <typename Node, typename... Fields>
  const Expression* make(ExpressionKind kind, Place place, Fields... fields) {
    static constexpr Expression kNotMade{ExpressionKind::kUndef, {}};
    if (is_preparsing()) return &kNotMade;
    void* memory = arena_->allocate(sizeof(Node), alignof(Node));
    if constexpr (sizeof...(fields) == 0)
      return new (memory) Node{kind, place};
    else
      return new (memory) Node{{kind, place}, fields...};
  }

  template <typename T>
  std::span<const T> make(const ArenaList<T>& list) {
    return is_preparsing() ? std::span<const T>{} : list.finish(*arena_);
  }
  const Scope* make(const ScopeBuilder& scope) {
    static constexpr Scope kNotMade{};
    return is_preparsing() ? &kNotMade : scope.finish(*arena_);
  }
  template <typename Body>
  DefinitionContent<Body>* make(const DefinitionContent<Body>& content) {
    return is_preparsing() ? nullptr : copy_to_arena(*arena_, content);
  }

  /// Makes the node of a literal, or of a variable, and consumes its token.
  template <typename Node, typename Field>
  const Expression* make_of_token(ExpressionKind kind, Field Token::*field) {
    const Token& token = tokens_[0];
    const Expression* node = make<Node>(kind, token.place, token.*field);
    consume();
    return node;
  }

  Lexer& lexer_;
  Program& program_;
  const SourceFiles& files_;
  const NameTable& names_;
  Arena* arena_;  // where nodes lie; null while a definition is preparsed
  Messages& messages_;
  std::stop_token stop_;

  Token tokens_[2];
  int ahead_ = 0;                     // tokens that were read and not consumed
  uint32_t depth_ = 0;                // see Nested
  uint32_t taken_ = 0;                // tokens
  bool is_behind_file_ = false;       // whether 0x03 was met
  std::vector<TopLevelItem> items_;   // of the statement that is parsed at the top level
  size_t warnings_of_top_level_ = 0;  // about what stands there
  uint32_t unsaid_ = 0;               // warnings that may be said when another file is the main one
  ScopeStacks scopes_;
  std::vector<Argument> arguments_;
  std::vector<Parameter> parameters_;
  std::vector<const Expression*> elements_;
};

/// Counts the symbols that OpenSCAD's parser would stack, and fails where it runs out of memory.
class Parser::Nested {
 public:
  Nested(Parser& parser, uint32_t symbols) : parser_(parser), symbols_(symbols) {
    parser_.depth_ += symbols_;
    if (parser_.depth_ > parser_.program_.dialect.most_symbols)
      parser_.lexer_.fail("memory exhausted");
  }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  ~Nested() { parser_.depth_ -= symbols_; }

 private:
  Parser& parser_;
  uint32_t symbols_;
};

}  // namespace language
