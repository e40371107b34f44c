// Random expressions of OpenSCAD's language over all operators, builtin functions and types of
// values, for comparisons with openscad.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace language {

/// An expression of constants: what it evaluates to depends on nothing else.
struct RandomExpression {
  enum class Kind {
    kLiteral,
    kUnary,
    kBinary,
    kTernary,
    kIndex,
    kMember,
    kCall,
    kVector,
    kRange,  // two or three parts
  };
  Kind kind = Kind::kLiteral;
  std::string token;  // a literal's text, an operator's sign, a member's or function's name
  std::vector<RandomExpression> parts;  // operands, arguments or elements, as they are written
};

/// Returns an expression that nests `depth` operators at most. Equal states of `random` give equal
/// expressions on every machine.
RandomExpression random_expression(std::mt19937& random, int depth);

/// Returns an expression's text, with parentheses around all operands.
std::string expression_text(const RandomExpression& expression);

}  // namespace language
