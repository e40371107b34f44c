// Values that outlive their evaluation: copies that share nothing with it, and whether they are the
// same as others.
#pragma once

#include <unordered_map>

#include "language/value.hpp"

namespace language {

/// Copies values with all that they hold. Objects that several of them share are shared by the
/// copies, too. Counts of references are no atomics, so what is kept while trees of older
/// evaluations are used elsewhere may not share objects with them.
class ValueCopier {
 public:
  /// `elements`: of vectors, and bytes of strings, that may be copied at most.
  explicit ValueCopier(size_t elements = ~size_t{0}) : elements_left_(elements) {}
  /// Returns a copy; unset if the value is unset, or holds a function or vectors nested very
  /// deeply, or too much.
  Value copy(const Value& value) { return copy(value, 0); }

 private:
  Value copy(const Value& value, int depth);
  Value copy_object(const Value& value, int depth);

  size_t elements_left_;
  std::unordered_map<const SharedObject*, Value> copies_;
};

/// Returns whether no program could tell two values from each other. May be false for large ones
/// that it could not tell.
bool are_identical(const Value& left, const Value& right);

}  // namespace language
