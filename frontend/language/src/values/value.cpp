#include "language/value.hpp"

namespace language {

bool Value::is_object_true() const {
  switch (type_) {
    case ValueType::kString:
      return !text().empty();
    case ValueType::kVector:
      return !elements().empty();
    case ValueType::kRange:
    case ValueType::kFunction:
      return true;
    default:
      return false;
  }
}

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
  }
  return {};
}

}  // namespace language
