// The syntax tree of OpenSCAD's language (LANGUAGE.md, "Grammar"), as it is written: nothing is
// resolved yet.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/name_table.hpp"
#include "language/node_kind.hpp"
#include "language/source_files.hpp"

namespace language {

// All nodes lie in the arena of their Program (syntax/program.hpp) and need no destruction.

enum class ExpressionKind : uint8_t {
  kUndef,
  kBool,
  kNumber,
  kString,
  kVariable,
  kUnary,
  kBinary,  // also && and ||
  kTernary,
  kIndex,
  kMember,
  kCall,
  kVector,
  kRange,
  kFunction,
  // The same three stand in expressions, and in vectors as comprehensions:
  kLet,
  kAssert,
  kEcho,
  // Comprehensions, which stand only within vectors:
  kFor,
  kForC,
  kIf,
  kEach,
};

enum class UnaryOperator : uint8_t {  // a unary plus leaves no trace
  kNegate,
  kNot,
  kComplement,  // ~, which OpenSCAD 2021.01 does not know
};

enum class BinaryOperator : uint8_t {
  kPower,
  kMultiply,
  kDivide,
  kModulo,
  kAdd,
  kSubtract,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kAnd,
  kOr,
  // OpenSCAD 2021.01 does not know these:
  kBitAnd,
  kBitOr,
  kShiftLeft,
  kShiftRight,
};

struct Expression {
  ExpressionKind kind;
  Place place;  // of the first token: of an operator's left operand, of its parenthesis
};

struct Argument {
  Name name;  // kNoName: positional
  const Expression* value;
  Place place;
};

struct Parameter {
  Name name;
  const Expression* value;  // null: no default
  Place place;
};

struct BoolExpression : Expression {
  bool value;
};
struct NumberExpression : Expression {
  double value;
};
struct StringExpression : Expression {
  std::string_view text;  // without quotes, escapes replaced
};
struct VariableExpression : Expression {
  Name name;
};
struct UnaryExpression : Expression {
  UnaryOperator op;
  const Expression* operand;
};
struct BinaryExpression : Expression {
  BinaryOperator op;
  const Expression* left;
  const Expression* right;
};
struct TernaryExpression : Expression {
  const Expression* condition;
  const Expression* then_value;
  const Expression* else_value;
};
struct IndexExpression : Expression {
  const Expression* container;
  const Expression* index;
};
struct MemberExpression : Expression {
  const Expression* container;
  Name member;
};
struct CallExpression : Expression {
  const Expression* callee;  // a VariableExpression for f(1)
  std::span<const Argument> arguments;
};
struct VectorExpression : Expression {
  std::span<const Expression* const> elements;  // expressions and comprehensions
};
struct RangeExpression : Expression {
  const Expression* begin;
  const Expression* step;  // null: not written
  const Expression* end;
};
struct FunctionExpression : Expression {  // function(parameters) body
  std::span<const Parameter> parameters;
  const Expression* body;
};
struct BodyExpression : Expression {    // kLet, kAssert, kEcho, kFor
  std::span<const Argument> arguments;  // of kFor one, unless the dialect joins loops
  const Expression* body;               // null: assert() or echo() without one
};
struct ForCExpression : Expression {
  std::span<const Argument> init;
  const Expression* condition;
  std::span<const Argument> increment;
  const Expression* body;
};
struct IfExpression : Expression {
  const Expression* condition;
  const Expression* then_element;
  const Expression* else_element;  // null: none
};
struct EachExpression : Expression {
  const Expression* element;  // an expression or a comprehension
};

/// Casts to the node type that belongs to the expression's kind.
template <typename Node>
const Node& as(const Expression& expression) {
  return static_cast<const Node&>(expression);
}

struct Assignment {
  Name name;
  const Expression* value;
  Place place;    // of the name; where a scope assigns it twice, of the last
  Place first{};  // where a scope assigns it twice, of the first; else it has no file
};

struct Scope;

/// A module call, or an `if`, whose name is kNoName.
struct ModuleCall {
  Name name;
  uint8_t modifiers = 0;  // CallModifier
  Place place;            // of the name; of an `if`, of its `)`
  std::span<const Argument> arguments;
  const Expression* condition = nullptr;  // of an `if`
  const Scope* children = nullptr;        // never null: empty if there are none
  const Scope* else_children = nullptr;   // of an `if` with `else`
};

class Arena;

/// What a definition says behind its name. Most of a library is never called, so a definition of a
/// kept file has this made when it is first asked for: DefinitionReader.
template <typename Body>
struct DefinitionContent {
  std::span<const Parameter> parameters;
  const Body* body;        // null: not made yet
  Arena* arena = nullptr;  // where it lies when it is made
};

struct FunctionDefinition {
  Name name;
  Place place;
  using Content = DefinitionContent<Expression>;
  Content* content;
  uint32_t begin = 0;  // where it begins in the file of its place
};

struct ModuleDefinition {
  Name name;
  Place place;  // of the `)` that ends its parameters
  using Content = DefinitionContent<Scope>;
  Content* content;
  uint32_t begin = 0;  // where it begins in the file of its place
};

/// A file's top level, a module's body or a child block. Each list is in source order; of names
/// that are defined twice the definition that counts stands in the list, once.
struct Scope {
  std::span<const Assignment> assignments;  // position of the first, all else of the last
  std::span<const FunctionDefinition> functions;
  std::span<const ModuleDefinition> modules;
  std::span<const ModuleCall> calls;
};

/// Appends an expression in OpenSCAD's normal form (LANGUAGE.md, "Grammar"). Does not recurse.
void append_expression_text(std::string& out, const Expression& expression, const NameTable& names);

}  // namespace language
