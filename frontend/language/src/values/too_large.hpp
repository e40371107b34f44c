// What keeps values, and the texts of values, from growing without end.
#pragma once

#include <cstddef>
#include <new>

namespace language {

/// Thrown where a text or a vector would become larger than it may; what() is the error that is
/// said.
class TooLarge : public std::bad_alloc {
 public:
  explicit TooLarge(const char* text) : text_(text) {}
  const char* what() const noexcept override { return text_; }

 private:
  const char* text_;
};

/// How deeply vectors may nest that an operator makes, or that are shown. OpenSCAD 2021.01 ends
/// without a word at some 14,000 to 28,000, where its stack does.
constexpr size_t kMostNesting = 30'000;

}  // namespace language
