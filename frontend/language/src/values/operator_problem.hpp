// What operators have to say.
#pragma once

#include <string>
#include <string_view>

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

}  // namespace language
