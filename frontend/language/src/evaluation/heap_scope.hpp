// Scopes whose variables outlive or are shared beyond a frame: those that function values, nested
// definitions and child blocks refer to; and function values, which hold one each.
#pragma once

#include <cstdint>
#include <string>

#include "code/code.hpp"
#include "language/value.hpp"
#include "values/function_object.hpp"

namespace language {

class HeapScopes;

/// A scope with its variables behind it in the same block.
struct HeapScope {
  uint32_t references;
  uint32_t size;
  HeapScope* parent;  // counted; null for the top level of a file
  HeapScopes* owner;
  HeapScope *previous, *next;  // in the list of all scopes
  Value* values() { return reinterpret_cast<Value*>(this + 1); }
};
static_assert(sizeof(HeapScope) % alignof(Value) == 0);

/// Makes scopes, and knows all that exist: function values and the scopes that hold them refer to
/// each other, so some are left when nothing else refers to them.
class HeapScopes {
 public:
  HeapScopes() = default;
  HeapScopes(const HeapScopes&) = delete;
  HeapScopes& operator=(const HeapScopes&) = delete;
  ~HeapScopes() { clear(); }

  /// Returns a scope with one reference, whose variables are unset. Takes over a reference to
  /// `parent`.
  HeapScope* make(HeapScope* parent, uint32_t size);
  static HeapScope* acquire(HeapScope* scope) {
    if (scope) ++scope->references;
    return scope;
  }
  static void release(HeapScope* scope) noexcept {
    if (scope && --scope->references == 0) destroy(scope);
  }
  /// Empties all scopes that are left. Functions that refer to them may not be called any more.
  void clear() noexcept;

 private:
  static void destroy(HeapScope* scope) noexcept;

  HeapScope* first_ = nullptr;
};

/// A function value: a function literal and the scope that it was evaluated in.
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
