// What is known of expressions before they are compiled: their values, and whether they contain
// function literals.
#pragma once

#include <unordered_map>

#include "language/value.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Returns the value of a number, a string, true, false, undef, a negated number, or a vector of
/// these; unset for all else.
Value constant_value(const Expression& expression);

/// Returns whether an expression is a literal as OpenSCAD means it: the same, with unary
/// operators, vectors and ranges of literals.
bool is_literal(const Expression& expression);

/// Remembers its answers, for the expressions of one function or scope.
class LiteralFinder {
 public:
  /// Returns whether a function literal stands anywhere in an expression.
  bool contains_literal(const Expression& expression);

 private:
  std::unordered_map<const Expression*, bool> answers_;
};

}  // namespace language
