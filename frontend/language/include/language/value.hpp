// A value of OpenSCAD's language: 16 bytes; what does not fit is shared and counted.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace language {

enum class ValueType : uint8_t {
  kUnset,  // no value: a variable whose assignment has not been evaluated. No expression yields it
  kUndef,
  kBool,
  kNumber,
  kString,
  kVector,
  kRange,
  kFunction,
};

struct StringObject;    // values/string_object.hpp: bytes, and the number of code points
struct VectorObject;    // values/vector_object.hpp: elements in one block
struct RangeObject;     // values/range.hpp: begin, step, end
struct FunctionObject;  // evaluation/function_object.hpp: code and captured scope

/// What is counted: the head of each object. One evaluation runs in one thread, so the count is no
/// atomic. An object deletes itself without recursion, however deeply vectors are nested.
struct SharedObject {
  uint32_t references = 1;
  ValueType type;
};

/// Copies share their object; an object does not change once it is shared.
class Value {
 public:
  Value() : type_(ValueType::kUndef), number_(0) {}
  Value(double number) : type_(ValueType::kNumber), number_(number) {}
  static Value unset() { return Value(ValueType::kUnset); }
  static Value undef() { return Value(); }
  static Value boolean(bool boolean) {
    Value value(ValueType::kBool);
    value.boolean_ = boolean;
    return value;
  }
  /// Takes over one reference to an object.
  static Value adopt(SharedObject* object) {
    Value value(object->type);
    value.object_ = object;
    return value;
  }

  Value(const Value& other) : type_(other.type_), number_(other.number_) { acquire(); }
  Value(Value&& other) noexcept : type_(other.type_), number_(other.number_) {
    other.type_ = ValueType::kUndef;
  }
  Value& operator=(const Value& other) {
    Value(other).swap(*this);
    return *this;
  }
  Value& operator=(Value&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Value() { release(); }
  void swap(Value& other) noexcept {
    std::swap(type_, other.type_);
    std::swap(number_, other.number_);
  }

  ValueType type() const { return type_; }
  bool is_set() const { return type_ != ValueType::kUnset; }
  bool is_undef() const { return type_ == ValueType::kUndef; }
  bool is_bool() const { return type_ == ValueType::kBool; }
  bool is_number() const { return type_ == ValueType::kNumber; }
  bool is_string() const { return type_ == ValueType::kString; }
  bool is_vector() const { return type_ == ValueType::kVector; }
  bool is_range() const { return type_ == ValueType::kRange; }
  bool is_function() const { return type_ == ValueType::kFunction; }

  // Each of the following may be called for values of that type only.
  bool boolean() const { return boolean_; }
  double number() const { return number_; }
  std::string_view text() const;            // bytes, perhaps invalid UTF-8
  std::span<const Value> elements() const;  // of a vector
  const RangeObject& range() const;
  const FunctionObject& function() const;
  SharedObject* object() const { return object_; }

  /// Returns OpenSCAD's truth: false are false, 0, "", [] and undef (LANGUAGE.md, "Values").
  bool is_true() const;

 private:
  explicit Value(ValueType type) : type_(type), number_(0) {}
  bool is_shared() const { return type_ >= ValueType::kString; }
  void acquire() {
    if (is_shared()) ++object_->references;
  }
  void release() {
    if (is_shared() && --object_->references == 0) destroy(object_);
  }
  static void destroy(SharedObject* object) noexcept;

  ValueType type_;
  union {
    double number_;
    bool boolean_;
    SharedObject* object_;
  };
};
static_assert(sizeof(Value) == 16);

/// Returns the name that messages use: "undefined", "bool", "number", "string", "vector", "range",
/// "function".
std::string_view type_name(ValueType type);

}  // namespace language
