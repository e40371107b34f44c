// Shared objects that hold other values by members of their own.
#pragma once

#include <cstddef>

#include "language/value.hpp"
#include "values/object_memory.hpp"

namespace language {

/// Its destructor may release other values; a chain of such objects that hold each other is
/// destroyed without recursion.
struct CompoundObject : SharedObject {
  CompoundObject() = default;
  CompoundObject(const CompoundObject&) = delete;
  CompoundObject& operator=(const CompoundObject&) = delete;
  virtual ~CompoundObject() = default;
  static void* operator new(size_t bytes) { return allocate_object(bytes); }
  static void operator delete(void* object, size_t bytes) noexcept { free_object(object, bytes); }

  CompoundObject* next_dead = nullptr;  // used while it is being destroyed
};

}  // namespace language
