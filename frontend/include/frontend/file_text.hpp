// The text of a file, and a test that can end its reading early.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>
#include <utility>

namespace frontend {

/// The largest input: locations and offsets in a syntax tree are 32 bits wide.
constexpr std::size_t kMaxInputBytes = 0xFFFFFFFFu;

/// A copy of a file's text, so that changes of the file while it is parsed have no effect. Copies
/// of this share it.
class FileText {
 public:
  FileText() = default;
  FileText(std::unique_ptr<char[]> bytes, std::size_t size)
      : bytes_(std::move(bytes)), size_(size) {}
  explicit FileText(std::string_view text) : size_(text.size()) {
    auto bytes = std::make_unique_for_overwrite<char[]>(size_);
    std::copy(text.begin(), text.end(), bytes.get());
    bytes_ = std::move(bytes);
  }
  std::string_view view() const { return {bytes_.get(), size_}; }
  const std::shared_ptr<const char[]>& bytes() const { return bytes_; }

 private:
  std::shared_ptr<const char[]> bytes_;
  std::size_t size_ = 0;
};

/// Returns whether a text that begins with `start` cannot be parsed, whatever comes after. So an
/// endless input need not be read on. Throws Stopped (stop.hpp) once `stop` is requested.
using IsHopeless = std::function<bool(std::string_view start, const std::stop_token& stop)>;

}  // namespace frontend
