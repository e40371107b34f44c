// Text whose end is not known while it is read.
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

/// Its room is not filled with zeros first: a .csg may have hundreds of MB.
class GrowingText {
 public:
  /// The bytes to make room for at first, at least, and the room in which small files end.
  static constexpr std::size_t kFirstRoom = std::size_t{1} << 16;

  /// `expected`: how many bytes there probably are; 0: not known.
  explicit GrowingText(std::size_t expected) {
    // One byte more than there are, so that the end shows without growing.
    grow(std::max(std::min(expected, kMaxInputBytes) + 1, kFirstRoom));
  }
  std::size_t size() const { return size_; }
  bool is_too_large() const { return size_ > kMaxInputBytes; }
  std::string_view view() const { return {bytes_.get(), size_}; }
  /// Where the next bytes belong: room for one at least, unless is_too_large().
  std::span<char> room() {
    if (size_ == capacity_) grow(std::min(2 * capacity_, kMaxInputBytes + 1));
    return {bytes_.get() + size_, capacity_ - size_};
  }
  /// So many bytes stand there now.
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

/// Looks whether a text that still comes is hopeless, at lengths each 16 times the last: in all it
/// reads a fifteenth of the text twice, and of what is wrong no more than 16 times is taken in as
/// there is before the fault.
class StartCheck {
 public:
  /// `size`: of the whole text, of which only the start is looked at; 0: it may be endless.
  StartCheck(IsHopeless is_hopeless, std::size_t size)
      : is_hopeless_(std::move(is_hopeless)), is_endless_(size == 0) {
    if (size > 0 && size <= GrowingText::kFirstRoom) next_ = kNever;
  }
  /// Bytes to read before the next look.
  std::size_t until_next(std::size_t size) const { return next_ - size; }
  /// `text`: all that has come, no more than until_next() wanted. True where there is no use in
  /// reading on. Throws Stopped (stop.hpp).
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
