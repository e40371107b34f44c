// Numbers in the texts of exported files.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace frontend {

/// Appends the shortest text that reads back to the same number, which is finite. Zero has no sign.
template <typename Real>
void append_number(std::string& text, Real number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number + Real{0});
  text.append(digits.data(), end.ptr);
}

/// Appends the finite number with at most so many digits behind the point, and no exponent.
inline void append_fixed(std::string& text, double number, int precision) {
  std::array<char, 350> digits;  // the largest double has 309 digits before the point
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number,
                                 std::chars_format::fixed, precision);
  std::string written(digits.data(), end.ptr);
  if (precision > 0) {
    written.erase(written.find_last_not_of('0') + 1);
    if (written.back() == '.') written.pop_back();
  }
  text += written == "-0" ? "0" : written;
}

}  // namespace frontend
