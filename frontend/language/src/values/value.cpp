#include "language/value.hpp"

namespace language {

std::string_view type_name(ValueType type) {
  switch (type) {
    case ValueType::kUnset:
    case ValueType::kUndef:
      return "undefined";
    case ValueType::kBool:
      return "bool";
    case ValueType::kNumber:
      return "number";
    case ValueType::kString:
      return "string";
    case ValueType::kVector:
      return "vector";
    case ValueType::kRange:
      return "range";
    case ValueType::kFunction:
      return "function";
    case ValueType::kObject:
      return "object";
  }
  return {};
}

}  // namespace language
