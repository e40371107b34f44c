// The machine's stack of values.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "language/value.hpp"
#include "values/object_memory.hpp"

namespace language {

/// A growing block of values, which counts among their memory. What lies above top() is no object.
/// Values are moved as bytes: none refers to its own place.
class ValueStack {
 public:
  ValueStack() { reserve(kFirstSize); }
  ValueStack(const ValueStack&) = delete;
  ValueStack& operator=(const ValueStack&) = delete;
  ~ValueStack() {
    drop_to(0);
    std::free(values_);
    object_memory.used -= static_cast<int64_t>(capacity_ * sizeof(Value));
  }

  uint32_t size() const { return static_cast<uint32_t>(top_ - values_); }
  Value& operator[](uint32_t index) { return values_[index]; }
  Value& top() { return top_[-1]; }
  Value& below(uint32_t depth) { return top_[-1 - static_cast<ptrdiff_t>(depth)]; }
  Value* begin() { return values_; }
  Value* end() { return top_; }
  /// Makes values objects or no longer ones: those below `end` are.
  void set_end(Value* end) { top_ = end; }

  // The next two need room that reserve() has made.
  void push(Value value) { new (top_++) Value(std::move(value)); }
  void push_copy(const Value& value) { new (top_++) Value(value); }
  Value pop() {
    Value value = std::move(*--top_);
    std::destroy_at(top_);
    return value;
  }
  /// Moves the topmost values to where there are no objects yet.
  void pop_to(Value* to, uint32_t count) {
    top_ -= count;
    std::memcpy(static_cast<void*>(to), top_, count * sizeof(Value));
  }
  void drop() { std::destroy_at(--top_); }
  void drop_to(uint32_t size) {
    while (top_ > values_ + size) std::destroy_at(--top_);
  }
  /// Makes room up to `size` values. They may move.
  void reserve(uint32_t size) {
    if (size > capacity_) grow(size);
  }

 private:
  static constexpr uint32_t kFirstSize = 1024;

  void grow(uint32_t size) {
    size_t capacity = capacity_ ? capacity_ : kFirstSize;
    while (capacity < size) capacity *= 2;
    const uint32_t used = values_ ? this->size() : 0;
    const size_t bytes_before = capacity_ * sizeof(Value), bytes = capacity * sizeof(Value);
    check_text_size(bytes - bytes_before);
    void* block = std::realloc(static_cast<void*>(values_), bytes);
    if (!block) throw std::bad_alloc();
    object_memory.used += static_cast<int64_t>(bytes - bytes_before);
    values_ = static_cast<Value*>(block);
    top_ = values_ + used;
    capacity_ = static_cast<uint32_t>(capacity);
  }

  Value* values_ = nullptr;
  Value* top_ = nullptr;
  uint32_t capacity_ = 0;
};

}  // namespace language
