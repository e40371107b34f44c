// Function values: a function literal and the scope that it was evaluated in.
#pragma once

#include <string>

#include "code/code.hpp"
#include "evaluation/heap_scope.hpp"
#include "values/function_object.hpp"

namespace language {

struct Closure final : FunctionObject {
  /// Adds a reference to the scope.
  Closure(FunctionEntry& entry, HeapScope* captured, const NameTable& known_names)
      : function(entry), scope(HeapScopes::acquire(captured)), names(known_names) {}
  ~Closure() override { HeapScopes::release(scope); }
  void append_text(std::string& out) const override;

  FunctionEntry& function;
  HeapScope* const scope;
  const NameTable& names;
};

inline const Closure& closure_of(const Value& function) {
  return static_cast<const Closure&>(*function.object());
}

/// Releases a scope that its code leaves, also where nothing but functions that it holds itself
/// keep it.
void leave_scope(HeapScope* scope) noexcept;

}  // namespace language
