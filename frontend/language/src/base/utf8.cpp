#include "base/utf8.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace language {
namespace {

bool is_ascii(char byte) { return static_cast<unsigned char>(byte) < 0x80; }

// Returns the length that a first byte announces. Bytes that begin nothing stand for themselves;
// F8 to FD announced 5 and 6 bytes before UTF-8 was cut to 10FFFF.
size_t announced_length(char first_byte) {
  const int ones = std::countl_one(static_cast<unsigned char>(first_byte));
  return ones < 2 || ones > 6 ? 1 : static_cast<size_t>(ones);
}

uint32_t least_of_length(size_t length) {
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  return kLeast[length];
}

}  // namespace

size_t code_point_length(std::string_view text) {
  return std::min(announced_length(text.front()), text.size());
}

size_t code_point_offset(std::string_view text, size_t index) {
  size_t offset = 0;
  for (; index > 0 && offset < text.size(); --index)
    offset += code_point_length(text.substr(offset));
  return offset;
}

size_t count_code_points(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_ascii)) return text.size();
  size_t count = 0;
  for (size_t offset = 0; offset < text.size(); ++count)
    offset += code_point_length(text.substr(offset));
  return count;
}

bool is_code_point(uint32_t number) {
  return number <= 0x10FFFF && (number < 0xD800 || number > 0xDFFF);
}

uint32_t first_code_point(std::string_view text) {
  const size_t length = code_point_length(text);
  auto code_point = static_cast<uint32_t>(static_cast<unsigned char>(text.front()));
  if (length == 1) return code_point;
  code_point &= 0x7Fu >> length;
  for (const char byte : text.substr(1, length - 1))
    code_point = code_point << 6 | (static_cast<unsigned char>(byte) & 0x3Fu);
  return code_point;
}

bool is_valid_utf8(std::string_view text) {
  for (size_t offset = 0; offset < text.size();) {
    const std::string_view rest = text.substr(offset);
    const size_t length = announced_length(rest.front());
    if (length == 1 && !is_ascii(rest.front())) return false;
    if (length > 4 || length > rest.size()) return false;
    const auto is_continuation = [](char byte) { return (byte & 0xC0) == 0x80; };
    if (!std::all_of(rest.begin() + 1, rest.begin() + static_cast<std::ptrdiff_t>(length),
                     is_continuation))
      return false;
    const uint32_t code_point = first_code_point(rest);
    if (code_point < least_of_length(length) || !is_code_point(code_point)) return false;
    offset += length;
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
