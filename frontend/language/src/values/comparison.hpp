// How values compare (LANGUAGE.md, "Values"): without recursion, however deeply vectors nest.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "language/value.hpp"
#include "values/operators.hpp"

namespace language {

enum class Ordering : uint8_t {
  kLess,
  kGreater,
  kNeither,    // equal, or not comparable numbers (NaN)
  kUndefined,  // OpenSCAD refuses to compare them; the problem says why
};

/// Compares two values for an operator that `sign` spells; elements of vectors are compared by "<".
Ordering order(const Value& left, std::string_view sign, const Value& right,
               OperatorProblem& problem);

bool are_equal(const Value& left, const Value& right);

/// Return the warnings of operators: "undefined operation (number + string)", and "operation
/// undefined (undefined < undefined)" for the comparison of two of a type that has no order.
std::string undefined_operation(const Value& left, std::string_view sign, const Value& right);
std::string operation_undefined(const Value& left, std::string_view sign, const Value& right);

}  // namespace language
