#include "language/make.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include "base/utf8.hpp"
#include "values/object_memory.hpp"

namespace language {
namespace {

constexpr size_t kMostElements = 0xFFFFFFFFu;

size_t checked(size_t capacity) {
  if (capacity > kMostElements) throw OutOfValueMemory();
  return capacity;
}

size_t block_size(size_t capacity) { return sizeof(VectorObject) + capacity * sizeof(Value); }

VectorObject* allocate_vector(size_t capacity) {
  void* block = allocate_object(block_size(checked(capacity)));
  auto* vector = new (block) VectorObject;
  vector->type = ValueType::kVector;
  vector->size = 0;
  vector->capacity = static_cast<uint32_t>(capacity);
  return vector;
}

VectorObject& vector_of(const Value& value) { return static_cast<VectorObject&>(*value.object()); }

}  // namespace

UnboundedValues::UnboundedValues() : used_(object_memory.used), limit_(object_memory.limit) {
  object_memory.limit = std::numeric_limits<int64_t>::max() / 2;
}

UnboundedValues::~UnboundedValues() { object_memory = {used_, limit_}; }

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
  vector->take_appended(static_cast<uint32_t>(elements.size()));
  return Value::adopt(vector);
}

void make_room(Value& value, size_t count) {
  constexpr size_t kLeastGrown = 4;
  VectorObject& vector = vector_of(value);
  const size_t size = vector.size, needed = size + count;
  if (value.is_unique() && needed <= vector.capacity) return;
  const size_t capacity = std::max({needed, 2 * size, kLeastGrown});
  if (!value.is_unique()) {
    Value copied = make_vector(capacity);
    VectorObject& copy = vector_of(copied);
    std::uninitialized_copy_n(vector.elements(), size, copy.elements());
    copy.size = vector.size;
    copy.holds_numbers = vector.holds_numbers;
    value = std::move(copied);
    return;
  }
  // Values may be moved as bytes: none refers to its own place.
  auto* const moved = static_cast<VectorObject*>(
      resize_object(&vector, block_size(vector.capacity), block_size(checked(capacity))));
  moved->capacity = static_cast<uint32_t>(capacity);
  static_cast<void>(value.disown());
  value = Value::adopt(moved);
}

void append_elements(Value& value, std::span<const Value> elements) {
  // The elements may be the vector's own, which move or vanish with the old block.
  const Value kept = vector_of(value).elements() == elements.data() ? value : Value();
  count_work(elements.size());
  make_room(value, elements.size());
  VectorObject& vector = vector_of(value);
  std::uninitialized_copy(elements.begin(), elements.end(), vector.elements() + vector.size);
  vector.take_appended(static_cast<uint32_t>(elements.size()));
}

}  // namespace language
