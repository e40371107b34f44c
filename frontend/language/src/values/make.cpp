#include "language/make.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "base/utf8.hpp"
#include "values/compound_object.hpp"
#include "values/object_memory.hpp"
#include "values/range.hpp"

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

size_t block_size(const StringObject& string) { return sizeof(StringObject) + string.size; }
size_t block_size(const VectorObject& vector) {
  return sizeof(VectorObject) + size_t{vector.capacity} * sizeof(Value);
}

// Frees an object that holds no other.
void free_plain(SharedObject* object) {
  if (object->type == ValueType::kString)
    free_object(object, block_size(static_cast<StringObject&>(*object)));
  else
    free_object(object, sizeof(RangeObject));
}

// Compound objects that are to be destroyed. A destructor may release further ones; they are listed
// here and destroyed one after the other, which keeps the depth of calls fixed.
thread_local CompoundObject* dead_compounds = nullptr;
thread_local bool destroys_compounds = false;

void destroy_compound(CompoundObject* compound) {
  compound->next_dead = std::exchange(dead_compounds, compound);
  if (destroys_compounds) return;
  destroys_compounds = true;
  while (CompoundObject* next = dead_compounds) {
    dead_compounds = next->next_dead;
    delete next;
  }
  destroys_compounds = false;
}

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

// Dead vectors wait in a list. Its links need no memory: a vector's link takes the place of its
// first element, which is therefore released when the vector is put into the list.
class Destroyer {
 public:
  void run(VectorObject* vector) {
    put(vector);
    while (VectorObject* dead = list_) {
      list_ = static_cast<VectorObject*>(link(dead));
      for (uint32_t i = 1; i < dead->size; ++i) release(dead->elements()[i]);
      free_object(dead, block_size(*dead));
    }
  }

 private:
  // Frees a vector that refers to no object: most hold numbers.
  static bool free_plain(VectorObject* vector) {
    if (!vector->holds_numbers) {
      const Value* const elements = vector->elements();
      for (uint32_t i = 0; i < vector->size; ++i)
        if (elements[i].is_shared()) return false;
    }
    free_object(vector, block_size(*vector));
    return true;
  }

  // The first element's payload: of a dead vector, the next dead vector.
  static SharedObject*& link(VectorObject* vector) { return vector->elements()->payload_.object; }

  static SharedObject* take_if_last(Value& value) {
    SharedObject* object = value.is_unique() ? value.payload_.object : nullptr;
    if (object) value.type_ = ValueType::kUndef;
    return object;
  }

  void release(Value& value) {
    SharedObject* object = take_if_last(value);
    if (!object)
      std::destroy_at(&value);
    else if (object->type == ValueType::kVector)
      put(static_cast<VectorObject*>(object));
    else
      Value::destroy(object);
  }

  void put(VectorObject* vector) {
    while (vector && !free_plain(vector)) {
      Value& first = *vector->elements();
      SharedObject* object = take_if_last(first);
      if (!object) std::destroy_at(&first);
      link(vector) = std::exchange(list_, vector);
      if (object && object->type != ValueType::kVector)
        Value::destroy(std::exchange(object, nullptr));
      vector = static_cast<VectorObject*>(object);
    }
  }

  VectorObject* list_ = nullptr;
};

void Value::destroy(SharedObject* object) noexcept {
  if (object->type == ValueType::kVector)
    Destroyer().run(static_cast<VectorObject*>(object));
  else if (object->type >= ValueType::kFunction)
    destroy_compound(static_cast<CompoundObject*>(object));
  else
    free_plain(object);
}

}  // namespace language
