// A cursor over the tokens of a .csg (frontend/OPENSCAD.md, "The .csg file"). It is a header, so
// that the parser's loops, which read every byte of a file, inline it.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "frontend/error.hpp"

namespace frontend {

/// Quotes a word of the file for a message. Control and non-ASCII bytes become \xNN, and a long
/// word is shortened: a name in a damaged file may be as long as the file.
std::string quoted(std::string_view word);

class Lexer {
 public:
  /// `text` must outlive the lexer.
  Lexer(std::string_view text, const std::string& file_name)
      : begin_(text.data()), end_(begin_ + text.size()), at_(begin_), file_name_(file_name) {}

  bool at_end() const { return at_ == end_; }
  /// Returns the next byte, or NUL at the end (a NUL byte is as wrong as the end there).
  char peek() const { return at_ == end_ ? '\0' : *at_; }
  void advance() { ++at_; }
  const char* position() const { return at_; }

  void skip_space();
  /// Takes the next byte if it is `c`. Returns whether it was.
  bool take(char c);
  /// Returns whether the rest of the text starts with `literal`.
  bool ahead(std::string_view literal) const { return rest().starts_with(literal); }
  bool at_word() const { return at_ != end_ && is_word_start(*at_); }
  /// Takes the identifier at the cursor. Precondition: at_word().
  std::string_view word();
  bool at_number() const { return at_ != end_ && (is_digit(*at_) || *at_ == '.'); }
  /// Takes the unsigned decimal number at the cursor, correctly rounded. Precondition: at_number().
  double number();
  /// Takes a number of the common form: perhaps a minus, a few digits, no exponent. Returns false,
  /// and takes nothing, if there is none.
  bool plain_number(double& value);
  /// Moves back to an earlier position.
  void go_back(const char* position) { at_ = position; }
  /// Takes a string with its quotes, and returns what is between them, escapes as written.
  std::string_view quoted_string();
  /// Takes `text`'s argument as OpenSCAD writes it: `kTextStart`, anything, `kTextEnd`. OpenSCAD
  /// escapes neither quotes nor line breaks, so that `text` may contain them. The cursor then
  /// stands at the comma of kTextEnd. Returns false, and takes nothing, if a person wrote a string
  /// that ends as others do.
  bool raw_text(std::string_view& text);

  [[noreturn]] void fail(const char* at, const std::string& what, const std::string& todo) const;
  [[noreturn]] void fail(const std::string& what, const std::string& todo) const {
    fail(at_, what, todo);
  }
  /// Fails with "expected X, found Y" at the cursor; at the end of the text, it says that the file
  /// is cut off.
  [[noreturn]] void fail_expected(const std::string& expected, const std::string& todo) const;

  /// After a failure: returns whether the end of the text may be what has failed, so that more text
  /// could mend it.
  bool may_be_cut_off() const { return seeks_end_ || end_ - at_ <= kLongestRest; }

 private:
  /// The most bytes that a token cut by the end leaves unread: "e+" of a number, "text = " of a
  /// text.
  static constexpr ptrdiff_t kLongestRest = 16;

  static constexpr std::string_view kTextStart = "text = \"";
  static constexpr std::string_view kTextEnd = "\", size = ";

  static bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
  static bool is_word_start(char c) {
    return static_cast<unsigned char>((c | 0x20) - 'a') < 26 || c == '_' || c == '$';
  }
  static std::string_view after_space(std::string_view text);
  std::string_view rest() const { return {at_, static_cast<size_t>(end_ - at_)}; }
  void skip_comment();
  bool plain_digits(double& value);
  double number_by_library();
  /// Returns the quote in [from, to) that ends an ordinary string whose first byte is at `from`, or
  /// `to`.
  static const char* closing_quote(const char* from, const char* to);
  static bool ends_by_hand(std::string_view between);

  const char* begin_;
  const char* end_;
  const char* at_;
  const char* text_end_ = nullptr;  // where kTextEnd was found last, so that no part of the text is
                                    // searched twice
  bool seeks_end_ = false;          // the end of a comment, string or text is missing
  const std::string& file_name_;
};

inline void Lexer::skip_space() {
  for (; at_ != end_; ++at_) {
    const char c = *at_;
    if (c == '/') {
      skip_comment();
      --at_;  // the loop steps on
    } else if (c != ' ' && (c < '\t' || c > '\r')) {
      return;
    }
  }
}

inline bool Lexer::take(char c) {
  if (at_ == end_ || *at_ != c) return false;
  ++at_;
  return true;
}

inline std::string_view Lexer::word() {
  const char* const first = at_;
  do {
    ++at_;
  } while (at_ != end_ && (is_word_start(*at_) || is_digit(*at_)));
  return {first, static_cast<size_t>(at_ - first)};
}

inline double Lexer::number() {
  double value;
  return plain_digits(value) ? value : number_by_library();
}

inline bool Lexer::plain_number(double& value) {
  const char* const start = at_;
  const bool negative = take('-');
  if (plain_digits(value)) {
    if (negative) value = -value;
    return true;
  }
  at_ = start;
  return false;
}

/// Returns false, and takes nothing, if the number needs the library.
inline bool Lexer::plain_digits(double& value) {
  // The result is exact if the digits form an integer below 2^53 and the power of ten is exact in
  // double (10^22 is the last): one division of two exact doubles is correctly rounded. The six
  // digits of %g always qualify.
  static constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr ptrdiff_t kExactDigits = 15;  // 10^15 < 2^53
  const char* p = at_;
  uint64_t digits = 0;
  while (p != end_ && is_digit(*p)) digits = digits * 10 + static_cast<uint64_t>(*p++ - '0');
  ptrdiff_t count = p - at_;
  ptrdiff_t decimals = 0;
  if (p != end_ && *p == '.') {
    const char* const point = p++;
    while (p != end_ && is_digit(*p)) digits = digits * 10 + static_cast<uint64_t>(*p++ - '0');
    decimals = p - point - 1;
    count += decimals;
  }
  const bool exponent = p != end_ && (*p | 0x20) == 'e';
  if (exponent || count > kExactDigits || count == 0) return false;
  at_ = p;
  value = static_cast<double>(digits);
  if (decimals > 0) value /= kPowers[static_cast<size_t>(decimals)];
  return true;
}

inline void Lexer::skip_comment() {
  if (ahead("//")) {
    at_ += std::min(rest().find('\n'), rest().size());
  } else if (ahead("/*")) {
    const size_t close = rest().find("*/", 2);
    if (close == std::string_view::npos) {
      seeks_end_ = true;
      fail("the comment is not closed", "end it with */");
    }
    at_ += close + 2;
  } else {
    fail("'/' outside a comment", "a .csg holds values, no expressions");
  }
}

/// Returns whether the magnitude of a decimal number that overflows or underflows a double is below
/// 1.
inline bool is_below_one(std::string_view number) {
  const size_t exponent_at = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, exponent_at);
  std::string_view exponent = number.substr(std::min(exponent_at + 1, number.size()));
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  int64_t shift = 0;
  const auto [end, error] = std::from_chars(exponent.begin(), exponent.end(), shift);
  if (error == std::errc::result_out_of_range) return exponent.starts_with('-');
  const int64_t first =
      static_cast<int64_t>(std::min(digits.find_first_of("123456789"), digits.size()));
  const int64_t point = static_cast<int64_t>(std::min(digits.find('.'), digits.size()));
  // No text is long enough to make up for an exponent of 2^40 (the parser takes 4 GiB).
  constexpr int64_t kFar = int64_t{1} << 40;
  return point - first + std::clamp(shift, -kFar, kFar) <= 0;
}

inline double Lexer::number_by_library() {
  double value = 0;
  const auto [end, error] = std::from_chars(at_, end_, value);
  if (error == std::errc::invalid_argument) fail_expected("a number", "write digits");
  const bool out_of_range = error == std::errc::result_out_of_range || std::isinf(value);
  if (out_of_range) {
    const char* const start = at_;
    at_ = end;
    if (!is_below_one({start, static_cast<size_t>(end - start)})) {
      fail(start, "the number is too large",
           "the largest is 1.79769e+308; infinity is written inf");
    }
    value = 0;
  }
  at_ = end;
  return value;
}

inline const char* Lexer::closing_quote(const char* from, const char* to) {
  for (const char* p = from; p < to; ++p) {
    if (*p == '"') return p;
    if (*p == '\\' && p + 1 < to) ++p;
  }
  return to;
}

inline std::string_view Lexer::quoted_string() {
  const char* const first = at_ + 1;
  const char* const quote = closing_quote(first, end_);
  if (quote == end_) {
    seeks_end_ = true;
    fail("the string is not closed", "end it with '\"'");
  }
  at_ = quote + 1;
  return {first, static_cast<size_t>(quote - first)};
}

inline std::string_view Lexer::after_space(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size()));
}

/// Returns whether a person wrote the string: `between`, the text from its closing quote to
/// kTextEnd, continues as OpenSCAD never writes it. Either an argument other than size follows; or
/// the node ends, and there is a later text to which kTextEnd may belong.
inline bool Lexer::ends_by_hand(std::string_view between) {
  between = after_space(between);
  if (between.starts_with(',')) {
    between = after_space(between.substr(1));
    size_t length = 0;
    while (length < between.size() && (is_word_start(between[length]) || is_digit(between[length])))
      ++length;
    return length > 0 && after_space(between.substr(length)).starts_with('=');
  }
  if (!between.starts_with(')')) return false;
  between = after_space(between.substr(1));
  if (!between.starts_with(';') && !between.starts_with('{')) return false;
  constexpr std::string_view kText = "text";
  for (size_t at = between.find(kText); at != std::string_view::npos;
       at = between.find(kText, at + 1)) {
    if (after_space(between.substr(at + kText.size())).starts_with('(')) return true;
  }
  return false;
}

inline bool Lexer::raw_text(std::string_view& text) {
  if (!ahead(kTextStart)) return false;
  const char* const first = at_ + kTextStart.size();
  if (text_end_ < first) {
    const std::string_view left(first, static_cast<size_t>(end_ - first));
    text_end_ = first + std::min(left.find(kTextEnd), left.size());
  }
  if (text_end_ == end_) {
    seeks_end_ = true;
    return false;
  }
  const char* const quote = closing_quote(first, text_end_);
  if (quote < text_end_ && ends_by_hand({quote + 1, static_cast<size_t>(text_end_ - quote - 1)})) {
    return false;
  }
  text = {first, static_cast<size_t>(text_end_ - first)};
  at_ = text_end_ + 1;
  return true;
}

inline std::string quoted(std::string_view word) {
  constexpr size_t kLongest = 40;
  constexpr const char* kHex = "0123456789ABCDEF";
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F) {
      text += c;
    } else {
      text += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return text + (word.size() > kLongest ? "...'" : "'");
}

inline void Lexer::fail(const char* at, const std::string& what, const std::string& todo) const {
  Location place{1, 1};
  for (const char* p = begin_; p != at; ++p) {
    place = *p == '\n' ? Location{place.line + 1, 1} : Location{place.line, place.column + 1};
  }
  throw Error(file_name_, place, what, todo);
}

inline void Lexer::fail_expected(const std::string& expected, const std::string& todo) const {
  if (at_end()) {
    fail("expected " + expected + ", found the end of the file",
         "if the file is cut off, export it again");
  }
  const char* last = at_ + 1;
  while (at_word() && last != end_ && (is_word_start(*last) || is_digit(*last))) ++last;
  fail("expected " + expected + ", found " + quoted({at_, static_cast<size_t>(last - at_)}), todo);
}

}  // namespace frontend
