// Products of two vectors, vectors of vectors among them (LANGUAGE.md, "Values").
#pragma once

#include "language/value.hpp"
#include "values/operator_problem.hpp"

namespace language {

/// Returns left * right of two vectors: a dot product, or a product with a matrix, as their first
/// elements say.
Value multiply_vectors(const Value& left, const Value& right, OperatorProblem& problem);

}  // namespace language
