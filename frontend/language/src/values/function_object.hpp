// What values have to know of a function literal; the evaluator derives its closures from it.
#pragma once

#include <string>

#include "values/compound_object.hpp"

namespace language {

/// A function value.
struct FunctionObject : CompoundObject {
  FunctionObject() { type = ValueType::kFunction; }
  /// Appends the text of the literal, as echo() shows it: "function(a, b = 1) (a + b)".
  virtual void append_text(std::string& out) const = 0;
};

inline const FunctionObject& Value::function() const {
  return static_cast<const FunctionObject&>(*payload_.object);
}

}  // namespace language
