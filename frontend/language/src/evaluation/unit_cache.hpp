// Top levels of used files, kept where evaluating them anew could not be observed.
#pragma once

#include <cstdint>

#include "evaluation/heap_scope.hpp"
#include "evaluation/kept_tops.hpp"

namespace language {

/// What the evaluation of a top level depended on.
struct UnitRecord {
  uint32_t unit;
  uint32_t trail;     // when it began
  uint64_t messages;  // that had been said when it began
  /// It has called no rands() or parent_module(), made no function value, and met nothing that only
  /// the first call of a run does.
  bool is_pure = true;
  NamedValues reads{};  // `$` names that others had bound, once each; unset: not bound
};

/// A top level that can be used again while the `$` names that it read have the same values.
struct KeptUnit {
  HeapScope* scope = nullptr;  // counted; null: none is kept
  NamedValues reads;
  NamedValues bindings;       // `$` names that it binds, in order
  bool is_looked_up = false;  // among those of earlier evaluations
  bool is_loaded = false;     // from there
};

}  // namespace language
