// An array that grows without copying.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace language {

/// A std::vector for elements that may be moved as bytes, because they do not refer to their own
/// place: a large block grows by realloc(), which moves pages instead of copying and touching them.
template <typename Element>
class GrowingArray {
 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray(std::move(other)).swap(*this);
    return *this;
  }
  ~GrowingArray() {
    std::destroy_n(data_, size_);
    std::free(static_cast<void*>(data_));
  }
  void swap(GrowingArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  size_t size() const { return size_; }
  Element* data() { return data_; }
  const Element* data() const { return data_; }
  Element& operator[](size_t index) { return data_[index]; }
  const Element& operator[](size_t index) const { return data_[index]; }
  Element& back() { return data_[size_ - 1]; }
  const Element* begin() const { return data_; }
  const Element* end() const { return data_ + size_; }

  void push_back(Element element) {
    if (size_ == capacity_) grow(1);
    std::construct_at(data_ + size_++, std::move(element));
  }
  /// The elements must not be the array's own.
  void append(std::span<const Element> elements) {
    if (capacity_ - size_ < elements.size()) grow(elements.size());
    std::uninitialized_copy(elements.begin(), elements.end(), data_ + size_);
    size_ += elements.size();
  }
  /// Removes all elements from `size` on.
  void truncate(size_t size) {
    std::destroy_n(data_ + size, size_ - size);
    size_ = size;
  }

 private:
  void grow(size_t count) {
    constexpr size_t kLeast = 64;
    const size_t capacity = std::max({kLeast, 2 * capacity_, size_ + count});
    void* const block = std::realloc(static_cast<void*>(data_), capacity * sizeof(Element));
    if (block == nullptr) throw std::bad_alloc();
    data_ = static_cast<Element*>(block);
    capacity_ = capacity;
  }

  Element* data_ = nullptr;
  size_t size_ = 0;
  size_t capacity_ = 0;
};

}  // namespace language
