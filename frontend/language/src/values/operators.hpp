// OpenSCAD's operators (LANGUAGE.md, "Values"). No text is made unless something is wrong.
#pragma once

#include <string>
#include <string_view>

#include "base/dialect.hpp"
#include "language/value.hpp"

namespace language {

/// Returns whether an operator works on two numbers.
inline bool are_numbers(const Value& left, const Value& right) {
  return left.is_number() && right.is_number();
}

/// What an operator has to say beside its result. Both are warnings; empty: nothing.
struct OperatorProblem {
  std::string unplaced;  // said first, without a place
  std::string text;      // said at the operator expression's place
};

/// Returns "undefined operation (number + string)".
std::string undefined_operation(const Value& left, std::string_view sign, const Value& right);

/// Returns "operation undefined (undefined < undefined)", which is said where two values of one
/// type have no order.
std::string operation_undefined(const Value& left, std::string_view sign, const Value& right);

/// The evaluator computes with numbers alone itself: these are for all other values.
namespace operators {
Value add(const Value& left, const Value& right, OperatorProblem& problem);
Value subtract(const Value& left, const Value& right, OperatorProblem& problem);
Value multiply(const Value& left, const Value& right, OperatorProblem& problem);
Value divide(const Value& left, const Value& right, OperatorProblem& problem);
Value modulo(const Value& left, const Value& right, OperatorProblem& problem);
Value power(const Value& left, const Value& right, OperatorProblem& problem);
Value negate(const Value& operand, OperatorProblem& problem);
Value shift_left(const Value& left, const Value& right, OperatorProblem& problem);
Value shift_right(const Value& left, const Value& right, OperatorProblem& problem);
Value bit_and(const Value& left, const Value& right, OperatorProblem& problem);
Value bit_or(const Value& left, const Value& right, OperatorProblem& problem);
Value complement(const Value& operand, OperatorProblem& problem);
Value less(const Value& left, const Value& right, OperatorProblem& problem);
Value less_equal(const Value& left, const Value& right, OperatorProblem& problem);
Value greater(const Value& left, const Value& right, OperatorProblem& problem);
Value greater_equal(const Value& left, const Value& right, OperatorProblem& problem);
Value index(const Value& container, const Value& index);
/// Returns left * right of two vectors: a dot product, or a product with a matrix, as their first
/// elements say.
Value multiply_vectors(const Value& left, const Value& right, OperatorProblem& problem);
}  // namespace operators

bool are_equal(const Value& left, const Value& right);  // that are not both numbers
/// Returns whether two values are equal, which is defined for all.
inline bool equal(const Value& left, const Value& right) {
  if (are_numbers(left, right)) return left.number() == right.number();
  return are_equal(left, right);
}

/// Returns whether no program could tell two values from each other. May be false for large ones
/// that it could not tell.
bool are_identical(const Value& left, const Value& right);

/// Returns container[index], or undef.
inline Value element_at(const Value& container, const Value& index) {
  if (container.is_vector() && index.is_number()) {
    const double position = index.number();
    const auto elements = container.elements();
    if (position >= 0 && position < static_cast<double>(elements.size()))
      return elements[static_cast<size_t>(position)];
  }
  return operators::index(container, index);
}

/// Returns container.name, or undef.
Value member(const Value& container, std::string_view name, const Dialect& dialect);

}  // namespace language
