// How values compare (LANGUAGE.md, "Values"): without recursion, however deeply vectors nest.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/value.hpp"
#include "values/operator_problem.hpp"

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

}  // namespace language
