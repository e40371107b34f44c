#include "syntax/characters.hpp"

#include <cstring>

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

TokenKind sign_kind(const char* text) {
  const char next = text[1];
  switch (text[0]) {
    case '<':
      if (next == '<') return TokenKind::kShiftLeft;
      return next == '=' ? TokenKind::kLessEqual : TokenKind::kSign;
    case '>':
      if (next == '>') return TokenKind::kShiftRight;
      return next == '=' ? TokenKind::kGreaterEqual : TokenKind::kSign;
    case '=':
      return next == '=' ? TokenKind::kEqual : TokenKind::kSign;
    case '!':
      return next == '=' ? TokenKind::kNotEqual : TokenKind::kSign;
    case '&':
      return next == '&' ? TokenKind::kAnd : TokenKind::kSign;
    case '|':
      return next == '|' ? TokenKind::kOr : TokenKind::kSign;
    case '\x03':
      return TokenKind::kFileEnd;
    default:
      return std::strchr("()[]{};,:?+-*/%^#.~", text[0]) ? TokenKind::kSign : TokenKind::kUnknown;
  }
}

}  // namespace language
