#include <memory>
#include <utility>

#include "values/function_object.hpp"
#include "values/object_memory.hpp"
#include "values/range.hpp"

namespace language {
namespace {

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

// Functions that are to be destroyed. A destructor may release further functions; they are listed
// here and destroyed one after the other, which keeps the depth of calls fixed.
thread_local FunctionObject* dead_functions = nullptr;
thread_local bool destroys_functions = false;

void destroy_function(FunctionObject* function) {
  function->next_dead = std::exchange(dead_functions, function);
  if (destroys_functions) return;
  destroys_functions = true;
  while (FunctionObject* next = dead_functions) {
    dead_functions = next->next_dead;
    delete next;
  }
  destroys_functions = false;
}

}  // namespace

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
  else if (object->type == ValueType::kFunction)
    destroy_function(static_cast<FunctionObject*>(object));
  else
    free_plain(object);
}

}  // namespace language
