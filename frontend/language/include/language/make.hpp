// How strings and vectors are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "language/value.hpp"

namespace language {

/// As long as it lives, values of this thread may take all memory there is: they are not those of
/// an evaluation.
class UnboundedValues {
 public:
  UnboundedValues();
  ~UnboundedValues();
  UnboundedValues(const UnboundedValues&) = delete;
  UnboundedValues& operator=(const UnboundedValues&) = delete;

 private:
  const int64_t used_, limit_;  // before
};

Value make_string(std::string_view text);
/// Returns an empty vector with room for `capacity` elements.
Value make_vector(size_t capacity = 0);
Value make_vector(std::span<const Value> elements);

/// Makes `vector` the only reference to its object, with room for `count` more elements and, where
/// it has to move, for as many again as it has.
void make_room(Value& vector, size_t count);

/// Appends to a vector: in place, in amortised constant time, if `vector` is its only reference;
/// else `vector` becomes a copy with one more element.
inline void append_element(Value& vector, Value element) {
  auto* object = static_cast<VectorObject*>(vector.object());
  if (object->references != 1 || object->size == object->capacity) [[unlikely]] {
    make_room(vector, 1);
    object = static_cast<VectorObject*>(vector.object());
  }
  object->append(std::move(element));
}
/// The same where it is known that `vector` is the only reference and has room.
inline void append_in_room(Value& vector, Value element) {
  static_cast<VectorObject&>(*vector.object()).append(std::move(element));
}
/// Fills a new vector with numbers.
class NumberWriter {
 public:
  explicit NumberWriter(size_t capacity)
      : vector_(make_vector(capacity)), next_(object().elements()) {}
  /// There must be room.
  void put(double number) { std::construct_at(next_++, number); }
  Value take() {
    object().size = static_cast<uint32_t>(next_ - object().elements());
    return std::move(vector_);
  }

 private:
  VectorObject& object() { return static_cast<VectorObject&>(*vector_.object()); }

  Value vector_;
  Value* next_;
};
/// Appends all elements of a span, which may be the vector's own.
void append_elements(Value& vector, std::span<const Value> elements);

}  // namespace language
