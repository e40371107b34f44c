// A value of OpenSCAD's language: 16 bytes; what does not fit is shared and counted.
#pragma once

#include <cstdint>
#include <memory>
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
  kObject,
};

struct StringObject;    // below: bytes, and the number of code points
struct VectorObject;    // below: elements in one block
struct RangeObject;     // values/range.hpp: begin, step, end
struct FunctionObject;  // values/function_object.hpp: what a function value has to know
struct MembersObject;   // values/members_object.hpp: names with values

/// What is counted: the head of each object. One evaluation runs in one thread, so the count is no
/// atomic. An object deletes itself without recursion, however deeply vectors are nested.
struct SharedObject {
  uint32_t references = 1;
  ValueType type;
  bool holds_numbers = true;  // of a vector: no element is anything else
};

/// Copies share their object; an object does not change once it is shared.
class Value {
 public:
  Value() : type_(ValueType::kUndef) { payload_.number = 0; }
  Value(double number) : type_(ValueType::kNumber) { payload_.number = number; }
  static Value unset() { return Value(ValueType::kUnset); }
  static Value undef() { return Value(); }
  static Value boolean(bool boolean) {
    Value value(ValueType::kBool);
    value.payload_.boolean = boolean;
    return value;
  }
  /// Takes over one reference to an object.
  static Value adopt(SharedObject* object) {
    Value value(object->type);
    value.payload_.object = object;
    return value;
  }

  Value(const Value& other) : type_(other.type_), payload_(other.payload_) { acquire(); }
  Value(Value&& other) noexcept : type_(other.type_), payload_(other.payload_) {
    other.type_ = ValueType::kUndef;
  }
  Value& operator=(const Value& other) {
    Value(other).swap(*this);
    return *this;
  }
  Value& operator=(Value&& other) noexcept {
    Value(std::move(other)).swap(*this);
    return *this;
  }
  ~Value() { release(); }
  void swap(Value& other) noexcept {
    std::swap(type_, other.type_);
    std::swap(payload_, other.payload_);
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
  bool is_object() const { return type_ == ValueType::kObject; }

  // Each of the following may be called for values of that type only.
  bool boolean() const { return payload_.boolean; }
  double number() const { return payload_.number; }
  std::string_view text() const;            // bytes, perhaps invalid UTF-8
  std::span<const Value> elements() const;  // of a vector
  /// Returns whether all elements of a vector are numbers, without looking at them.
  bool holds_numbers() const { return payload_.object->holds_numbers; }
  const RangeObject& range() const;
  const FunctionObject& function() const;
  const MembersObject& members() const;  // of an object

  /// Returns the shared object of a string, vector, range, function or object.
  SharedObject* object() const { return payload_.object; }
  /// Returns whether this is the only reference to its object, which may then be changed.
  bool is_unique() const { return is_shared() && payload_.object->references == 1; }

  /// Gives up the reference to an object without counting it, and becomes undef.
  SharedObject* disown() {
    type_ = ValueType::kUndef;
    return payload_.object;
  }

  /// Returns OpenSCAD's truth: false are false, 0, "", [] and undef (LANGUAGE.md, "Values").
  bool is_true() const {
    if (type_ == ValueType::kBool) return payload_.boolean;
    if (type_ == ValueType::kNumber) return payload_.number != 0;
    return is_object_true();
  }

 private:
  friend class Destroyer;
  union Payload {
    double number;
    bool boolean;
    SharedObject* object;
  };

  explicit Value(ValueType type) : type_(type) { payload_.number = 0; }
  bool is_shared() const { return type_ >= ValueType::kString; }
  bool is_object_true() const;
  void acquire() {
    if (is_shared()) ++payload_.object->references;
  }
  void release() {
    if (is_shared() && --payload_.object->references == 0) destroy(payload_.object);
  }
  static void destroy(SharedObject* object) noexcept;

  ValueType type_;
  Payload payload_;  // copied as a whole, whichever member is active
};
static_assert(sizeof(Value) == 16);

/// A string; its bytes follow it in the same block.
struct StringObject : SharedObject {
  uint64_t size;
  uint64_t code_points;  // as base/utf8.hpp counts them; equal to `size` if all bytes are ASCII
  char* bytes() { return reinterpret_cast<char*>(this + 1); }
};

/// A vector; its elements follow it in the same block.
struct VectorObject : SharedObject {
  uint32_t size;
  uint32_t capacity;
  Value* elements() { return reinterpret_cast<Value*>(this + 1); }
  /// There must be room.
  void append(Value element) {
    holds_numbers = holds_numbers && element.is_number();
    std::construct_at(elements() + size++, std::move(element));
  }
  /// Takes over values that somebody has put behind the last element, where there must be room.
  void take_appended(uint32_t count) {
    for (const Value& element : std::span(elements() + size, count))
      holds_numbers = holds_numbers && element.is_number();
    size += count;
  }
};
static_assert(sizeof(VectorObject) == 16);

inline std::string_view Value::text() const {
  auto& string = static_cast<StringObject&>(*payload_.object);
  return {string.bytes(), string.size};
}

inline std::span<const Value> Value::elements() const {
  auto& vector = static_cast<VectorObject&>(*payload_.object);
  return {vector.elements(), vector.size};
}

/// Returns the name that messages use: "undefined", "bool", "number", "string", "vector", "range",
/// "function", "object".
std::string_view type_name(ValueType type);

}  // namespace language
