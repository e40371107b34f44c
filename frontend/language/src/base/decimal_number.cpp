#include "base/decimal_number.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace language {

namespace {

/// Returns the decimal exponent of a number's first digit that is not 0, which it must have,
/// roughly: exponents of more than six digits count as a million.
long first_digit_exponent(std::string_view text) {
  const size_t mark = text.find_first_of("eE");
  const std::string_view digits = text.substr(0, mark);
  const auto point =
      static_cast<long>(digits.find('.') == digits.npos ? digits.size() : digits.find('.'));
  const auto first = static_cast<long>(digits.find_first_of("123456789"));
  if (mark == text.npos) return point - first;
  std::string_view exponent = text.substr(mark + 1);
  const bool is_negative = exponent.starts_with('-');
  if (is_negative || exponent.starts_with('+')) exponent.remove_prefix(1);
  long value = 1'000'000;
  if (exponent.size() <= 6)
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
  return point - first + (is_negative ? -value : value);
}

/// Returns the number of few digits, without an exponent: a whole number and a power of ten that
/// are both exact, so that their quotient is rounded once.
std::optional<double> short_number(std::string_view text) {
  constexpr double kPowers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  if (text.size() >= std::size(kPowers)) return std::nullopt;
  uint64_t digits = 0;
  bool is_behind_point = false;
  size_t decimals = 0;
  for (const char c : text) {
    if (c == '.' && !is_behind_point) {
      is_behind_point = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    digits = 10 * digits + static_cast<uint64_t>(c - '0');
    decimals += is_behind_point;
  }
  return static_cast<double>(digits) / kPowers[decimals];
}

}  // namespace

std::optional<double> decimal_number(std::string_view text) {
  if (const auto number = short_number(text)) return number;
  double number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc::result_out_of_range) return number;
  // from_chars does not tell which end of the range it is.
  if (first_digit_exponent(text) > 0) return std::nullopt;
  return 0.0;
}

}  // namespace language
