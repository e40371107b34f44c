// Collects a text whose length is not known while it is read.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <string_view>
#include <utility>

#include "frontend/file_text.hpp"

namespace frontend {

/// A buffer that grows. Its room is not filled with zeros first: a .csg may have hundreds of MB.
class GrowingText {
 public:
  /// The least bytes of room made at first. Smaller files are read without growing.
  static constexpr std::size_t kFirstRoom = std::size_t{1} << 16;

  /// `expected` is the probable number of bytes; 0 if unknown.
  explicit GrowingText(std::size_t expected) {
    // One byte more than expected, so that the end of the file shows without growing.
    grow(std::max(std::min(expected, kMaxInputBytes) + 1, kFirstRoom));
  }
  std::size_t size() const { return size_; }
  bool is_too_large() const { return size_ > kMaxInputBytes; }
  std::string_view view() const { return {bytes_.get(), size_}; }
  /// Returns the room for the next bytes: one at least, unless is_too_large().
  std::span<char> room() {
    if (size_ == capacity_) grow(std::min(2 * capacity_, kMaxInputBytes + 1));
    return {bytes_.get() + size_, capacity_ - size_};
  }
  /// Counts `count` bytes that were written into room().
  void add(std::size_t count) { size_ += count; }
  FileText take() { return FileText(std::move(bytes_), std::exchange(size_, 0)); }

 private:
  void grow(std::size_t wanted) {
    auto larger = std::make_unique_for_overwrite<char[]>(wanted);
    if (size_ > 0) std::memcpy(larger.get(), bytes_.get(), size_);
    bytes_ = std::move(larger);
    capacity_ = wanted;
  }

  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_ = 0;
  std::size_t size_ = 0;
};

/// Tests, while a text is being read, whether it is hopeless (IsHopeless). It tests at lengths that
/// grow 16-fold, so that a fifteenth of the text is read twice. Of an endless text, at most 16
/// times the length up to its fault is read.
class StartCheck {
 public:
  /// `size` is that of the whole text, of which only one start is tested; 0: it may be endless.
  StartCheck(IsHopeless is_hopeless, std::size_t size)
      : is_hopeless_(std::move(is_hopeless)), is_endless_(size == 0) {
    if (size > 0 && size <= GrowingText::kFirstRoom) next_ = kNever;
  }
  /// Returns how many bytes to read before the next test.
  std::size_t until_next(std::size_t size) const { return next_ - size; }
  /// Returns whether there is no use in reading on. `text` is all that was read, at most
  /// until_next() bytes more than before. Throws Stopped (stop.hpp).
  bool fails(std::string_view text, const std::stop_token& stop) {
    if (text.size() < next_) return false;
    next_ = is_endless_ ? next_ * kFactor : kNever;
    return is_hopeless_(text, stop);
  }

 private:
  static constexpr std::size_t kFirst = 4096, kFactor = 16;
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
  IsHopeless is_hopeless_;
  bool is_endless_;
  std::size_t next_ = kFirst;
};

}  // namespace frontend
