#include "text.hpp"

#include <algorithm>
#include <utility>

namespace serve {
namespace {

/// Returns how many UTF-16 units a byte begins.
uint32_t utf16_units(char byte) {
  const auto value = static_cast<unsigned char>(byte);
  return (value & 0xC0) == 0x80 ? 0 : value >= 0xF0 ? 2 : 1;
}

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace

Text::Text(std::string bytes) : bytes_(std::move(bytes)), starts_{0} {
  for (std::size_t i = bytes_.find_first_of("\r\n"); i != bytes_.npos;
       i = bytes_.find_first_of("\r\n", i)) {
    i += bytes_.compare(i, 2, "\r\n") == 0 ? 2 : 1;
    starts_.push_back(static_cast<uint32_t>(i));
  }
}

uint32_t Text::line_of(std::size_t offset) const {
  return static_cast<uint32_t>(std::ranges::upper_bound(starts_, offset) - starts_.begin() - 1);
}

Position Text::position_of(std::size_t offset, PositionEncoding encoding) const {
  offset = std::min(offset, bytes_.size());
  const uint32_t line = line_of(offset);
  const auto begin = bytes_.begin() + starts_[line];
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(offset);
  uint32_t character = 0;
  if (encoding == PositionEncoding::kUtf8) return {line, static_cast<uint32_t>(end - begin)};
  for (auto at = begin; at != end; ++at) character += utf16_units(*at);
  return {line, character};
}

uint32_t Text::offset_of(Position position, PositionEncoding encoding) const {
  if (position.line >= lines()) return size();
  const uint32_t next = position.line + 1;
  uint32_t end = next < lines() ? starts_[next] : size();
  uint32_t at = starts_[position.line];
  while (next < lines() && end > at && (bytes_[end - 1] == '\n' || bytes_[end - 1] == '\r')) --end;
  uint32_t left = position.character;
  while (at < end) {
    uint32_t after = at + 1;
    while (after < end && continues_character(bytes_[after])) ++after;
    const bool is_utf8 = encoding == PositionEncoding::kUtf8;
    const uint32_t units = is_utf8 ? after - at : std::max(1u, utf16_units(bytes_[at]));
    if (left < units) break;
    left -= units;
    at = after;
  }
  return at;
}

}  // namespace serve
