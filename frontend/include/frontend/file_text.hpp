// A text that was read, and what ends its reading early.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>
#include <utility>

namespace frontend {

/// Locations and offsets in a syntax tree are 32 bits wide.
constexpr std::size_t kMaxInputBytes = 0xFFFFFFFFu;

/// A file's text, a copy of its own: a file that changes while it is read cannot harm us.
class FileText {
 public:
  FileText() = default;
  FileText(std::unique_ptr<char[]> bytes, std::size_t size)
      : bytes_(std::move(bytes)), size_(size) {}
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Whether a text that begins with `start` is of no use, whatever comes after; so what never ends
/// need not be read. Throws Stopped (stop.hpp) where `stop` asks for it.
using IsHopeless = std::function<bool(std::string_view start, const std::stop_token& stop)>;

}  // namespace frontend
