// What values have to know of a function literal; the evaluator derives its closures from it.
#pragma once

#include <cstddef>
#include <string>

#include "language/value.hpp"
#include "values/object_memory.hpp"

namespace language {

/// A function value. Its destructor may release other values; a chain of functions that hold each
/// other is destroyed without recursion.
struct FunctionObject : SharedObject {
  FunctionObject() { type = ValueType::kFunction; }
  FunctionObject(const FunctionObject&) = delete;
  FunctionObject& operator=(const FunctionObject&) = delete;
  virtual ~FunctionObject() = default;
  static void* operator new(size_t bytes) { return allocate_object(bytes); }
  static void operator delete(void* object, size_t bytes) noexcept { free_object(object, bytes); }
  /// Appends the text of the literal, as echo() shows it: "function(a, b = 1) (a + b)".
  virtual void append_text(std::string& out) const = 0;

  FunctionObject* next_dead = nullptr;  // used while it is being destroyed
};

inline const FunctionObject& Value::function() const {
  return static_cast<const FunctionObject&>(*payload_.object);
}

}  // namespace language
