#include "text.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace report {
namespace {

constexpr int kDigits = 3;
/// In smaller numbers readers would have to count zeros.
constexpr double kLeastPlain = 1e-4;

std::string printed(const char* format, int precision, double value) {
  std::array<char, 400> text{};  // the largest double has 309 digits
  std::snprintf(text.data(), text.size(), format, precision, value);
  return text.data();
}

/// Inserts commas into a number in plain digits.
std::string with_commas(std::string text) {
  const size_t point = std::min(text.find('.'), text.size());
  const size_t first = text.front() == '-' ? 1 : 0;
  for (size_t place = point; place > first + 3;) {
    place -= 3;
    text.insert(place, ",");
  }
  return text;
}

/// Returns "2.1e-7".
std::string with_exponent(double value) {
  std::string text = printed("%.*e", 1, value);
  const size_t digits = text.find('e') + 2;
  while (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);
  const size_t zero = text.find(".0e");
  if (zero != std::string::npos) text.erase(zero, 2);
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string number(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  if (std::abs(value) < kLeastPlain) return with_exponent(value);
  if (value == std::round(value)) return whole_number(value);
  // The rounded number decides: 9.996 becomes 10.0.
  const double rounded = std::stod(printed("%.*e", kDigits - 1, value));
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(rounded))));
  return with_commas(printed("%.*f", std::max(0, kDigits - 1 - magnitude), rounded));
}

std::string whole_number(double value) { return with_commas(printed("%.*f", 0, value)); }

std::string bytes(double value) {
  static constexpr std::array kUnits{"bytes", "kB", "MB", "GB", "TB"};
  size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < kUnits.size(); ++unit) value /= 1'000;
  return number(value) + " " + kUnits[unit];
}

std::string percent(double share) { return number(100 * share) + "%"; }

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

void Table::add(std::vector<std::string> cells) {
  assert(cells.size() == head_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::markdown() const {
  std::string text = row(head_) + row(std::vector<std::string>(head_.size(), "---"));
  for (const auto& cells : rows_) text += row(cells);
  return text;
}

}  // namespace report
