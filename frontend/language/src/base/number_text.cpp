#include "base/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string_view>

namespace language {

namespace {

constexpr int kDigits = 6;        // significant digits of both formats
constexpr int kMostExponent = 5;  // beyond, both write an exponent

// A number's decimal digits: 0.‹first›‹second›… × 10^(exponent + 1).
struct Decimal {
  uint32_t digits;  // as an integer of kDigits digits
  int exponent;     // of the first digit
};

// Returns a decimal whose digits may have been rounded up to 10^kDigits.
Decimal carried(uint32_t digits, int exponent) {
  constexpr uint32_t kEnd = 1'000'000;
  return digits == kEnd ? Decimal{kEnd / 10, exponent + 1} : Decimal{digits, exponent};
}

// Reads what std::to_chars writes: "d.ddddde±xx".
Decimal read_scientific(std::string_view text) {
  Decimal decimal{0, 0};
  const size_t e = text.find('e');
  for (const char c : text.substr(0, e))
    if (c != '.') decimal.digits = decimal.digits * 10 + static_cast<uint32_t>(c - '0');
  const size_t sign = e + 1;
  for (const char c : text.substr(sign + 1)) decimal.exponent = decimal.exponent * 10 + (c - '0');
  if (text[sign] == '-') decimal.exponent = -decimal.exponent;
  return decimal;
}

// Returns a positive number rounded to so many digits; exact ties go to the even digit.
Decimal round_to_even(double number, int digits) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, number, std::chars_format::scientific, digits - 1);
  return read_scientific({text, end.ptr});
}

// Returns whether `number` is digits × 10^power exactly; `digits` is odd and below 10^7.
bool is_exactly(double number, uint64_t digits, int power) {
  constexpr uint64_t kMostMantissa = uint64_t{1} << 53;
  uint64_t odd = digits;  // number = odd × 2^power, if it is a binary fraction at all
  for (int i = power; i < 0; ++i) {
    if (odd % 5 != 0) return false;
    odd /= 5;
  }
  for (int i = 0; i < power; ++i) {
    odd *= 5;
    if (odd > kMostMantissa) return false;
  }
  return std::ldexp(static_cast<double>(odd), power) == number;
}

// Returns a positive number rounded to kDigits digits where that can be told from one product of
// doubles: where the number is far enough from a tie, and its exponent not too large.
std::optional<Decimal> round_quickly(double number) {
  constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr int kMostPower = 22;  // the last power of ten that is a double
  constexpr double kLeast = 1e5, kEnd = 1e6;
  // The product is wrong by 2^-53 of itself at most, which is below 1.2e-10.
  constexpr double kNearTie = 1e-9;
  constexpr double kDecimalsPerBinary = 0.30102999566398120;
  const auto scaled = [&](int power) {
    return power < 0 ? number / kPowers[-power] : number * kPowers[power];
  };
  const double magnitude = std::floor(std::ilogb(number) * kDecimalsPerBinary);
  int power = kDigits - 1 - static_cast<int>(magnitude);
  if (std::abs(power) >= kMostPower) return std::nullopt;
  double integer = scaled(power);
  if (integer >= kEnd) integer = scaled(--power);
  if (!(integer >= kLeast && integer < kEnd)) return std::nullopt;
  const double floor = std::floor(integer), part = integer - floor;
  if (std::abs(part - 0.5) < kNearTie) return std::nullopt;
  return carried(static_cast<uint32_t>(floor) + (part > 0.5 ? 1 : 0), kDigits - 1 - power);
}

// Returns a positive number rounded to kDigits digits; exact ties go away from zero.
Decimal round_away(double number) {
  if (const auto rounded = round_quickly(number)) return *rounded;
  const Decimal longer = round_to_even(number, kDigits + 1);
  if (longer.digits % 10 != 5) return round_to_even(number, kDigits);
  if (!is_exactly(number, longer.digits, longer.exponent - kDigits))
    return round_to_even(number, kDigits);
  return carried(longer.digits / 10 + 1, longer.exponent);
}

// Writes decimals to where the text is wanted.
class Writer {
 public:
  Writer(Decimal decimal, char* out) : exponent_(decimal.exponent), end_(out) {
    while (count_ > 1 && decimal.digits % 10 == 0) {
      decimal.digits /= 10;
      --count_;
    }
    for (int i = count_ - 1; i >= 0; --i, decimal.digits /= 10)
      digits_[i] = static_cast<char>('0' + decimal.digits % 10);
  }

  // Each returns the end of the text.
  char* plain() {
    if (exponent_ < 0) {
      put("0.");
      for (int i = exponent_ + 1; i < 0; ++i) put('0');
      for (int i = 0; i < count_; ++i) put(digits_[i]);
      return end_;
    }
    for (int i = 0; i <= exponent_ || i < count_; ++i) {
      if (i == exponent_ + 1) put('.');
      put(i < count_ ? digits_[i] : '0');
    }
    return end_;
  }

  char* scientific(int least_exponent_digits) {
    put(digits_[0]);
    if (count_ > 1) put('.');
    for (int i = 1; i < count_; ++i) put(digits_[i]);
    put('e');
    put(exponent_ < 0 ? '-' : '+');
    const int size = std::abs(exponent_);
    if (size < 10 && least_exponent_digits == 2) put('0');
    constexpr int kMostDigits = 3;
    return std::to_chars(end_, end_ + kMostDigits, size).ptr;
  }

 private:
  void put(char c) { *end_++ = c; }
  void put(std::string_view text) {
    for (const char c : text) put(c);
  }

  int exponent_;
  int count_ = kDigits;
  char digits_[kDigits];
  char* end_;
};

char* put(char* out, std::string_view text) { return std::copy(text.begin(), text.end(), out); }

// Returns the end of the text, or null if the number is none of few digits.
char* put_small_integer(char* out, double number) {
  constexpr double kMost = 1e6;
  constexpr int kMostCharacters = 7;
  if (!(std::abs(number) < kMost)) return nullptr;
  const int integer = static_cast<int>(number);
  if (integer != number) return nullptr;
  return std::to_chars(out, out + kMostCharacters, integer).ptr;
}

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

char* put_general_number(char* out, double number) {
  if (std::signbit(number)) *out++ = '-';
  const double size = std::abs(number);
  if (char* const end = put_small_integer(out, size)) return end;
  if (!std::isfinite(size)) return put(out, std::isnan(size) ? "nan" : "inf");
  const auto quick = round_quickly(size);
  const Decimal decimal = quick ? *quick : round_to_even(size, kDigits);
  Writer writer(decimal, out);
  constexpr int kLeastExponent = -4;
  const bool is_plain = decimal.exponent >= kLeastExponent && decimal.exponent <= kMostExponent;
  return is_plain ? writer.plain() : writer.scientific(2);
}

char* put_echo_number(char* out, double number) {
  if (char* const end = put_small_integer(out, number)) return end;
  if (std::isnan(number)) return put(out, "nan");
  if (number < 0) *out++ = '-';
  if (std::isinf(number)) return put(out, "inf");
  const Decimal decimal = round_away(std::abs(number));
  Writer writer(decimal, out);
  constexpr int kLeastExponent = -5;
  const bool is_plain = decimal.exponent >= kLeastExponent && decimal.exponent <= kMostExponent;
  return is_plain ? writer.plain() : writer.scientific(1);
}

void append_echo_number(std::string& out, double number) {
  char text[kMostNumberText];
  out.append(text, put_echo_number(text, number));
}

void append_general_number(std::string& out, double number) {
  char text[kMostNumberText];
  out.append(text, put_general_number(text, number));
}

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
