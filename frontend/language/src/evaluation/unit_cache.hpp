// Top levels of used files, kept where evaluating them anew could not be observed.
#pragma once

#include <cstdint>

#include "evaluation/heap_scope.hpp"
#include "evaluation/kept_tops.hpp"

namespace language {

/// A top level that can be used again while the `$` names that it read have the same values.
struct KeptUnit {
  HeapScope* scope = nullptr;  // counted; null: none is kept
  NamedValues reads;
  NamedValues bindings;       // `$` names that it binds, in order
  bool is_looked_up = false;  // among those of earlier evaluations
  bool is_loaded = false;     // from there
};

}  // namespace language
