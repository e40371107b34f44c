#include "base/number_text.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
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

// Writes decimals in place and appends them once.
class Writer {
 public:
  explicit Writer(Decimal decimal) : exponent_(decimal.exponent) {
    while (count_ > 1 && decimal.digits % 10 == 0) {
      decimal.digits /= 10;
      --count_;
    }
    for (int i = count_ - 1; i >= 0; --i, decimal.digits /= 10)
      digits_[i] = static_cast<char>('0' + decimal.digits % 10);
  }

  void plain() {
    if (exponent_ < 0) {
      put("0.");
      for (int i = exponent_ + 1; i < 0; ++i) put('0');
      for (int i = 0; i < count_; ++i) put(digits_[i]);
      return;
    }
    for (int i = 0; i <= exponent_ || i < count_; ++i) {
      if (i == exponent_ + 1) put('.');
      put(i < count_ ? digits_[i] : '0');
    }
  }

  void scientific(int least_exponent_digits) {
    put(digits_[0]);
    if (count_ > 1) put('.');
    for (int i = 1; i < count_; ++i) put(digits_[i]);
    put('e');
    put(exponent_ < 0 ? '-' : '+');
    const int size = std::abs(exponent_);
    if (size < 10 && least_exponent_digits == 2) put('0');
    end_ = std::to_chars(end_, text_ + sizeof text_, size).ptr;
  }

  void append_to(std::string& out) const { out.append(text_, size()); }

 private:
  size_t size() const { return static_cast<size_t>(end_ - text_); }
  void put(char c) { *end_++ = c; }
  void put(std::string_view text) {
    for (const char c : text) put(c);
  }

  int exponent_;
  int count_ = kDigits;
  char digits_[kDigits];
  char text_[32];
  char* end_ = text_;
};

bool append_small_integer(std::string& out, double number) {
  constexpr double kMost = 1e6;
  if (!(std::abs(number) < kMost) || number != std::trunc(number)) return false;
  char text[16];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<int>(number));
  out.append(text, static_cast<size_t>(end.ptr - text));
  return true;
}

}  // namespace

void append_echo_number(std::string& out, double number) {
  if (append_small_integer(out, number)) return;
  if (std::isnan(number)) {
    out += "nan";
    return;
  }
  if (number < 0) out += '-';
  if (std::isinf(number)) {
    out += "inf";
    return;
  }
  const Decimal decimal = round_away(std::abs(number));
  Writer writer(decimal);
  constexpr int kLeastExponent = -5;
  if (decimal.exponent < kLeastExponent || decimal.exponent > kMostExponent)
    writer.scientific(1);
  else
    writer.plain();
  writer.append_to(out);
}

void append_general_number(std::string& out, double number) {
  if (std::signbit(number)) out += '-';
  const double size = std::abs(number);
  if (append_small_integer(out, size)) return;
  if (!std::isfinite(size)) {
    out += std::isnan(size) ? "nan" : "inf";
    return;
  }
  const auto quick = round_quickly(size);
  const Decimal decimal = quick ? *quick : round_to_even(size, kDigits);
  Writer writer(decimal);
  constexpr int kLeastExponent = -4;
  if (decimal.exponent < kLeastExponent || decimal.exponent > kMostExponent)
    writer.scientific(2);
  else
    writer.plain();
  writer.append_to(out);
}

}  // namespace language
