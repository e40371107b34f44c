#include "values/make.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "base/utf8.hpp"
#include "values/object_memory.hpp"

namespace language {
namespace {

constexpr size_t kMostElements = 0xFFFFFFFFu;

VectorObject* allocate_vector(size_t capacity) {
  if (capacity > kMostElements) throw OutOfValueMemory();
  void* block = allocate_object(sizeof(VectorObject) + capacity * sizeof(Value));
  auto* vector = new (block) VectorObject;
  vector->type = ValueType::kVector;
  vector->size = 0;
  vector->capacity = static_cast<uint32_t>(capacity);
  return vector;
}

VectorObject& vector_of(const Value& value) { return static_cast<VectorObject&>(*value.object()); }

// Makes `value` the only reference to a vector with room for `capacity` elements: its elements are
// moved there if they were its own, else copied.
void move_to_new_block(Value& value, size_t capacity) {
  VectorObject& old = vector_of(value);
  Value moved = make_vector(capacity);
  VectorObject& vector = vector_of(moved);
  if (value.is_unique())
    std::uninitialized_move_n(old.elements(), old.size, vector.elements());
  else
    std::uninitialized_copy_n(old.elements(), old.size, vector.elements());
  vector.size = old.size;
  value = std::move(moved);
}

void make_room(Value& value, size_t count, bool grows_further) {
  const VectorObject& vector = vector_of(value);
  const size_t needed = vector.size + count;
  if (value.is_unique() && needed <= vector.capacity) return;
  constexpr size_t kLeastGrown = 4;
  move_to_new_block(
      value, grows_further ? std::max({needed, 2 * size_t{vector.size}, kLeastGrown}) : needed);
}

}  // namespace

Value make_string(std::string_view text) {
  auto* string = new (allocate_object(sizeof(StringObject) + text.size())) StringObject;
  string->type = ValueType::kString;
  string->size = text.size();
  string->code_points = count_code_points(text);
  if (!text.empty()) std::memcpy(string->bytes(), text.data(), text.size());
  return Value::adopt(string);
}

Value make_vector(size_t capacity) { return Value::adopt(allocate_vector(capacity)); }

Value make_vector(std::span<const Value> elements) {
  VectorObject* vector = allocate_vector(elements.size());
  std::uninitialized_copy(elements.begin(), elements.end(), vector->elements());
  vector->size = static_cast<uint32_t>(elements.size());
  return Value::adopt(vector);
}

void append_element(Value& value, Value element) {
  make_room(value, 1, true);
  VectorObject& vector = vector_of(value);
  std::construct_at(vector.elements() + vector.size, std::move(element));
  ++vector.size;
}

void append_elements(Value& value, std::span<const Value> elements) {
  // The elements may be the vector's own, which move or vanish with the old block.
  const Value kept = vector_of(value).elements() == elements.data() ? value : Value();
  make_room(value, elements.size(), true);
  VectorObject& vector = vector_of(value);
  std::uninitialized_copy(elements.begin(), elements.end(), vector.elements() + vector.size);
  vector.size += static_cast<uint32_t>(elements.size());
}

void reserve_elements(Value& value, size_t count) { make_room(value, count, false); }

}  // namespace language
