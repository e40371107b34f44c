// A text with its lines, and places in it as editors count them.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace serve {

/// A part of a text, in bytes: [begin, end).
struct Span {
  uint32_t begin = 0, end = 0;

  bool operator==(const Span&) const = default;
  /// Whether a cursor at the offset touches the part: its end counts.
  bool touches(std::size_t offset) const { return begin <= offset && offset <= end; }
};

/// What a position's `character` counts.
enum class PositionEncoding : uint8_t { kUtf16, kUtf8 };

/// Both count from 0.
struct Position {
  uint32_t line = 0;
  uint32_t character = 0;

  auto operator<=>(const Position&) const = default;
};

struct Range {
  Position start, end;

  auto operator<=>(const Range&) const = default;
};

/// One version of a text. It does not change: threads may share it. Lines end at LF, CR or both. A
/// byte that is no UTF-8 counts as one character.
class Text {
 public:
  explicit Text(std::string bytes);
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  const std::string& bytes() const { return bytes_; }
  uint32_t size() const { return static_cast<uint32_t>(bytes_.size()); }
  std::string_view at(Span span) const {
    return std::string_view(bytes_).substr(span.begin, span.end - span.begin);
  }
  uint32_t lines() const { return static_cast<uint32_t>(starts_.size()); }
  /// Returns the line of an offset, from 0.
  uint32_t line_of(std::size_t offset) const;
  uint32_t line_start(uint32_t line) const { return starts_[line]; }

  /// An offset beyond the end counts as the end.
  Position position_of(std::size_t offset, PositionEncoding encoding) const;
  Range range_of(Span span, PositionEncoding encoding) const {
    return {position_of(span.begin, encoding), position_of(span.end, encoding)};
  }
  /// A position beyond the end of its line counts as that end, and one within a character as the
  /// character's begin.
  uint32_t offset_of(Position position, PositionEncoding encoding) const;

 private:
  std::string bytes_;
  std::vector<uint32_t> starts_;  // of the lines
};

using TextPointer = std::shared_ptr<const Text>;

}  // namespace serve
