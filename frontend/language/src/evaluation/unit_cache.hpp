// Top levels of used files, kept where evaluating them anew could not be observed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "evaluation/heap_scope.hpp"
#include "language/value.hpp"

namespace language {

using NamedValues = std::vector<std::pair<Name, Value>>;

/// What the evaluation of a top level depended on.
struct UnitRecord {
  uint32_t unit;
  uint32_t trail;       // when it began
  uint64_t messages;    // that had been said when it began
  bool is_pure = true;  // it has called no rands() or parent_module() and made no function value
  NamedValues reads{};  // `$` names that others had bound; unset: not bound
};

/// A top level that can be used again while the `$` names that it read have the same values.
struct KeptUnit {
  HeapScope* scope = nullptr;  // counted; null: none is kept
  NamedValues reads;
  NamedValues bindings;  // `$` names that it binds, in order
};

/// Returns whether two values are the same object, or the same bits.
inline bool is_identical(const Value& left, const Value& right) {
  if (left.type() != right.type()) return false;
  switch (left.type()) {
    case ValueType::kUnset:
    case ValueType::kUndef:
      return true;
    case ValueType::kBool:
      return left.boolean() == right.boolean();
    case ValueType::kNumber:
      return left.number() == right.number();
    default:
      return left.object() == right.object();
  }
}

}  // namespace language
