// Which bytes the language's tokens consist of, and what escapes in strings mean (LANGUAGE.md,
// "Text").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "syntax/token.hpp"

namespace language {

enum CharacterClass : uint8_t {
  kBlankByte = 1,
  kWordByte = 2,
  kDigitByte = 4,
  kStringByte = 8,
  kSignByte = 16,
};

constexpr std::array<uint8_t, 256> kCharacterClasses = [] {
  std::array<uint8_t, 256> classes{};
  for (const unsigned char c : std::string_view(" \t\n\r")) classes[c] |= kBlankByte;
  for (const unsigned char c : std::string_view("()[]{};,:?+-*%^#~")) classes[c] |= kSignByte;
  for (int c = 0; c < 256; ++c) {
    const bool is_digit = '0' <= c && c <= '9';
    const bool is_letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
    if (is_digit) classes[c] |= kDigitByte;
    if (is_digit || is_letter || c == '_') classes[c] |= kWordByte;
    if (c != '\0' && c != '\n' && c != '"' && c != '\\') classes[c] |= kStringByte;
  }
  return classes;
}();

inline bool is_of(char c, CharacterClass wanted) {
  return (kCharacterClasses[static_cast<unsigned char>(c)] & wanted) != 0;
}
inline bool is_blank(char c) { return is_of(c, kBlankByte); }
inline bool is_word(char c) { return is_of(c, kWordByte); }
inline bool is_digit(char c) { return is_of(c, kDigitByte); }
/// Returns whether a byte is a token in itself, whatever follows it.
inline bool is_sign(char c) { return is_of(c, kSignByte); }
inline bool begins_number(char c) { return is_digit(c) || c == '.'; }
/// Returns whether a byte within a string is not simply a part of its value.
inline bool ends_plain_text(char c) { return !is_of(c, kStringByte); }

// The following read a text that ends with a NUL.

/// Returns the length of the number at the start of a text; 0: there is none.
size_t number_length(const char* text);

/// Returns the length of a path's part: up to `>`, a line end, a tab or the text's end.
size_t path_part_length(const char* text, const char* end);

/// Returns the length of the no-break spaces, or of the byte order mark, at the start of a text; 0:
/// there is none.
size_t wide_blank_length(const char* text);

/// Returns the kind of the sign at the start of a text.
TokenKind sign_kind(const char* text);

/// Returns whether a sign of this kind has two bytes. The others have one.
inline bool is_two_bytes(TokenKind kind) {
  return TokenKind::kLessEqual <= kind && kind <= TokenKind::kShiftRight;
}

/// Returns the length of a hexadecimal number, `0x1F`, at the start of a text; 0: there is none.
size_t hexadecimal_length(const char* text);

/// Returns the value of a hexadecimal number; nothing if it takes more than 64 bits.
std::optional<uint64_t> hexadecimal_integer(std::string_view number);

struct Escape {
  size_t length;
  bool is_defined;
};

/// Appends what the escape at the start of a text stands for. A backslash that begins none stands
/// for nothing. The text begins with a backslash and ends with a NUL.
Escape append_escape(const char* text, std::string& value);

}  // namespace language
