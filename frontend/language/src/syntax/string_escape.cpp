#include "syntax/string_escape.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace language {

namespace {

/// Returns the value of `count` hexadecimal digits; nothing if one of them is none.
std::optional<uint32_t> hexadecimal(const char* text, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const char lower = 'A' <= text[i] && text[i] <= 'F' ? static_cast<char>(text[i] + 32) : text[i];
    const size_t digit = kDigits.find(lower);
    if (digit == kDigits.npos) return std::nullopt;
    value = 16 * value + static_cast<uint32_t>(digit);
  }
  return value;
}

/// Appends a code point as UTF-8. What is none, and 0, counts as a blank.
void append_code_point(uint32_t code, std::string& value) {
  const auto append = [&](uint32_t byte) { value += static_cast<char>(byte); };
  if (code == 0 || code > 0x10FFFF || (0xD800 <= code && code <= 0xDFFF)) {
    value += ' ';
  } else if (code < 0x80) {
    append(code);
  } else {
    const int following = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    append((0xFF00u >> (following + 1) & 0xFF) | code >> 6 * following);
    for (int i = following - 1; i >= 0; --i) append(0x80 | (code >> 6 * i & 0x3F));
  }
}

/// Returns the number of digits that an escape with this letter has; 0: there is none.
size_t code_digits(char letter) {
  switch (letter) {
    case 'x':
      return 2;
    case 'u':
      return 4;
    case 'U':
      return 6;
    default:
      return 0;
  }
}

}  // namespace

size_t append_escape(const char* text, std::string& value) {
  constexpr std::string_view kLetters = "ntr\"\\", kMeanings = "\n\t\r\"\\";
  if (const size_t found = kLetters.find(text[1]); found != kLetters.npos) {
    value += kMeanings[found];
    return 2;
  }
  const size_t digits = code_digits(text[1]);
  const auto code = hexadecimal(text + 2, digits);
  if (digits == 0 || !code || (digits == 2 && *code > 0x7F)) return 1;
  append_code_point(*code, value);
  return 2 + digits;
}

}  // namespace language
