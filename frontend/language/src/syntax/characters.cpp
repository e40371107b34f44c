#include "syntax/characters.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "base/utf8.hpp"

namespace language {

namespace {

size_t digits_length(const char* text) {
  size_t length = 0;
  while (is_digit(text[length])) ++length;
  return length;
}

size_t exponent_length(const char* text) {
  if (*text != 'e' && *text != 'E') return 0;
  const size_t mark = text[1] == '+' || text[1] == '-' ? 2 : 1;
  const size_t digits = digits_length(text + mark);
  return digits > 0 ? mark + digits : 0;
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Returns the length of a character of several bytes at the start of a text; 0: there is none.
/// OpenSCAD lets overlong ones and surrogates pass.
size_t wide_character_length(const char* text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0xC2 || first > 0xF4) return 0;
  const size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  return length;
}

size_t wide_characters_length(const char* text) {
  size_t length = 0;
  while (const size_t next = wide_character_length(text + length)) length += next;
  return length;
}

/// No token begins with such a sign; what is no character ends the text for OpenSCAD.
TokenKind unknown_kind(const char* text) {
  const bool is_character = is_ascii(text[0]) || wide_character_length(text) > 0;
  return is_character ? TokenKind::kUnknown : TokenKind::kEnd;
}

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

size_t number_length(const char* text) {
  size_t length = digits_length(text);
  if (text[length] == '.') {
    const size_t fraction = digits_length(text + length + 1);
    if (length + fraction == 0) return 0;
    length += 1 + fraction;
  }
  return length > 0 ? length + exponent_length(text + length) : 0;
}

size_t path_part_length(const char* text, const char* end) {
  const char* at = text;
  while (at < end && *at != '>' && *at != '\n' && *at != '\r' && *at != '\t') ++at;
  return static_cast<size_t>(at - text);
}

/// OpenSCAD takes any run of a no-break space's two bytes for blanks, but prefers a longer
/// character.
size_t wide_blank_length(const char* text) {
  if (text[0] == '\xEF') return text[1] == '\xBB' && text[2] == '\xBF' ? 3 : 0;
  const size_t length = std::strspn(text, "\xC2\xA0");
  return wide_characters_length(text) > length ? 0 : length;
}

TokenKind sign_kind(const char* text) {
  if (is_sign(text[0])) return kind_of(text[0]);
  const auto either = [next = text[1]](char second, TokenKind kind, char otherwise) {
    return next == second ? kind : kind_of(otherwise);
  };
  switch (text[0]) {
    case '.':
    case '/':
      return kind_of(text[0]);
    case '<':
      if (text[1] == '<') return TokenKind::kShiftLeft;
      return either('=', TokenKind::kLessEqual, '<');
    case '>':
      if (text[1] == '>') return TokenKind::kShiftRight;
      return either('=', TokenKind::kGreaterEqual, '>');
    case '=':
      return either('=', TokenKind::kEqual, '=');
    case '!':
      return either('=', TokenKind::kNotEqual, '!');
    case '&':
      return either('&', TokenKind::kAnd, '&');
    case '|':
      return either('|', TokenKind::kOr, '|');
    case '\x03':
      return TokenKind::kFileEnd;
    default:
      return unknown_kind(text);
  }
}

size_t hexadecimal_length(const char* text) {
  constexpr size_t kPrefix = 2;
  if (text[0] != '0' || text[1] != 'x') return 0;
  size_t length = kPrefix;
  while (hexadecimal(text + length, 1)) ++length;
  return length > kPrefix ? length : 0;
}

std::optional<uint64_t> hexadecimal_integer(std::string_view number) {
  const std::string_view digits = number.substr(2);
  uint64_t integer = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), integer, 16);
  return read.ec == std::errc() ? std::optional(integer) : std::nullopt;
}

Escape append_escape(const char* text, std::string& value) {
  constexpr std::string_view kLetters = "ntr\"\\", kMeanings = "\n\t\r\"\\";
  if (const size_t found = kLetters.find(text[1]); found != kLetters.npos) {
    value += kMeanings[found];
    return {2, true};
  }
  const size_t digits = code_digits(text[1]);
  const auto code = hexadecimal(text + 2, digits);
  if (digits == 0 || !code || (digits == 2 && *code > 0x7F)) return {1, false};
  append_code_point(*code, value);
  return {2 + digits, true};
}

}  // namespace language
