// The language's words and signs.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/name_table.hpp"
#include "language/source_files.hpp"

namespace language {

enum class TokenKind : uint8_t {
  // Reserved words, in the order of kFirstNames.
  kModule,
  kFunction,
  kIf,
  kElse,
  kLet,
  kAssert,
  kEcho,
  kFor,
  kEach,
  kTrue,
  kFalse,
  kUndef,

  kName,
  kNumber,
  kString,
  kUse,      // use <path>
  kFileEnd,  // the byte 0x03 that OpenSCAD puts behind the main file and behind used ones
  kEnd,      // of all text
  kUnknown,  // what no token begins with, or what is not terminated
  kLessEqual,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kAnd,
  kOr,
  kShiftLeft,
  kShiftRight,
  // A sign of one byte is its own kind: kind_of(sign).
  kExclamation = '!',
  kHash = '#',
  kPercent = '%',
  kAmpersand = '&',
  kOpenParenthesis = '(',
  kCloseParenthesis = ')',
  kStar = '*',
  kPlus = '+',
  kComma = ',',
  kMinus = '-',
  kDot = '.',
  kSlash = '/',
  kColon = ':',
  kSemicolon = ';',
  kLess = '<',
  kAssign = '=',
  kGreater = '>',
  kQuestion = '?',
  kOpenBracket = '[',
  kCloseBracket = ']',
  kCaret = '^',
  kOpenBrace = '{',
  kBar = '|',
  kCloseBrace = '}',
  kTilde = '~',
};
constexpr size_t kTokenKinds = 128;

constexpr TokenKind kind_of(char sign) { return static_cast<TokenKind>(sign); }

/// The first names of every design's table: the reserved words, whose numbers are their token's
/// kinds, and two that are reserved before `<` only.
constexpr std::array<std::string_view, 14> kFirstNames = {
    "module", "function", "if",   "else",  "let",   "assert",  "echo",
    "for",    "each",     "true", "false", "undef", "include", "use"};
constexpr Name kIncludeName = 12;
constexpr Name kUseName = 13;

/// Gives kFirstNames the first numbers of a table, which must be empty.
inline void add_first_names(NameTable& names) {
  for (const std::string_view name : kFirstNames) names.intern(name);
}

/// What its kind does not have is left over from an earlier token.
struct Token {
  TokenKind kind = TokenKind::kEnd;
  Name name = kNoName;    // of a name or a reserved word
  Place place;            // of its first byte; of the last one of a string of several lines
  double number = 0;      // of kNumber
  std::string_view text;  // of a string, escapes replaced

  bool is(TokenKind wanted) const { return kind == wanted; }
  bool is(char wanted) const { return kind == kind_of(wanted); }
};

}  // namespace language
