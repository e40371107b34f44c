#include "base/utf8.hpp"

#include <algorithm>
#include <bit>

namespace language {
namespace {

// Returns the length that a first byte announces. Bytes that begin nothing stand for themselves;
// F8 to FD announced 5 and 6 bytes before UTF-8 was cut to 10FFFF.
size_t announced_length(char first_byte) {
  const int ones = std::countl_one(static_cast<unsigned char>(first_byte));
  return ones < 2 || ones > 6 ? 1 : static_cast<size_t>(ones);
}

// Returns the least code point that needs so many bytes.
uint32_t least_of_length(size_t length) {
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000, 0x200000, 0x4000000};
  return kLeast[length];
}

}  // namespace

size_t code_point_length(std::string_view text) {
  if (text.empty()) return 0;
  const size_t length = announced_length(text.front());
  return length <= text.size() ? length : 0;
}

size_t code_point_offset(std::string_view text, size_t index) {
  size_t offset = 0;
  for (; index > 0; --index) offset += code_point_length(text.substr(offset));
  return offset;
}

size_t count_code_points(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_ascii)) return text.size();
  size_t count = 0;
  for (; const size_t length = code_point_length(text); text.remove_prefix(length)) ++count;
  return count;
}

bool is_code_point(uint32_t number) {
  return number <= 0x10FFFF && (number < 0xD800 || number > 0xDFFF);
}

uint32_t first_code_point(std::string_view text) {
  const size_t length = code_point_length(text);
  if (length == 0) return kNoCodePoint;
  const auto first = static_cast<unsigned char>(text.front());
  if (length == 1) return is_ascii(text.front()) ? first : kNoCodePoint;
  uint32_t code_point = first & 0x7Fu >> length;
  for (const char byte : text.substr(1, length - 1)) {
    if ((byte & 0xC0) != 0x80) return kNoCodePoint;
    code_point = code_point << 6 | (static_cast<unsigned char>(byte) & 0x3Fu);
  }
  return code_point;
}

bool is_valid_utf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = code_point_length(text);
    const uint32_t code_point = first_code_point(text);
    if (!is_code_point(code_point) || code_point < least_of_length(length)) return false;
    text.remove_prefix(length);
  }
  return true;
}

void append_code_point(std::string& out, uint32_t code_point) {
  const auto tail = [&](int shift) {
    out += static_cast<char>(0x80 | (code_point >> shift & 0x3F));
  };
  if (code_point < 0x80) {
    out += static_cast<char>(code_point);
  } else if (code_point < 0x800) {
    out += static_cast<char>(0xC0 | code_point >> 6);
    tail(0);
  } else if (code_point < 0x10000) {
    out += static_cast<char>(0xE0 | code_point >> 12);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0 | code_point >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

}  // namespace language
