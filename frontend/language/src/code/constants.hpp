// Expressions whose value is known before they are evaluated.
#pragma once

#include "language/value.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Returns the value of a number, a string, true, false, undef, a negated number, or a vector of
/// these; unset for all else.
Value constant_value(const Expression& expression);

/// Returns whether an expression is a literal as OpenSCAD means it: the same, with unary
/// operators, vectors and ranges of literals.
bool is_literal(const Expression& expression);

}  // namespace language
