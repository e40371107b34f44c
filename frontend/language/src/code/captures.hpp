// Which expressions contain function literals: the variables around those live in the heap.
#pragma once

#include <unordered_map>

#include "syntax/syntax.hpp"

namespace language {

/// Remembers its answers, for the expressions of one function or scope.
class LiteralFinder {
 public:
  /// Returns whether a function literal stands anywhere in an expression.
  bool contains_literal(const Expression& expression);

 private:
  std::unordered_map<const Expression*, bool> answers_;
};

}  // namespace language
