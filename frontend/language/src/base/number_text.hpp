// Numbers: as text, in OpenSCAD's two formats (LANGUAGE.md, "Values"), of the language's text, and
// as integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace language {

/// Appends a number as echo() shows it: six significant digits, exact ties away from zero,
/// "1e+6" and "1e-6" where the exponent is outside [-5, 5].
void append_echo_number(std::string& out, double number);

/// Appends a number as C's "%g" does, in which most of a .csg is written.
void append_general_number(std::string& out, double number);

/// Characters that either of them takes at most: "-1.23457e+308".
constexpr size_t kMostNumberText = 13;
/// Writes what append_echo_number() appends. Returns its end.
char* put_general_number(char* out, double number);
char* put_echo_number(char* out, double number);

/// Returns the double nearest to a decimal number: digits with an optional point and exponent,
/// no sign. Numbers that are too small give 0; nothing is returned for those that are too large.
std::optional<double> decimal_number(std::string_view text);

/// Returns the nearest number of 32 bits, without its sign, to one that is cut; 0 for NaN.
inline uint32_t nearest_count(double number) {
  constexpr uint32_t kMost = std::numeric_limits<uint32_t>::max();
  if (number >= kMost) return kMost;
  return number > 0 ? static_cast<uint32_t>(number) : 0;
}

/// Returns the low 32 bits of a number cut to an integer; 0 for what 64 bits cannot hold.
inline uint32_t low_bits(double number) {
  constexpr double kEnd = 9223372036854775808.0;
  if (!(number >= -kEnd && number < kEnd)) return 0;
  return static_cast<uint32_t>(static_cast<int64_t>(number));
}

}  // namespace language
