#include "base/dialect.hpp"

#include <cmath>
#include <limits>

#include "base/number_text.hpp"

namespace language {

int Dialect::integer(double number) const {
  constexpr int kLeast = std::numeric_limits<int>::min(), kMost = std::numeric_limits<int>::max();
  const double whole = std::trunc(number);
  if (whole >= kLeast && whole <= kMost) return static_cast<int>(whole);
  if (!has_nearest_integers || whole < 0) return kLeast;
  return whole > 0 ? kMost : 0;
}

uint32_t Dialect::unsigned_integer(double number) const {
  return has_nearest_integers ? nearest_count(number) : low_bits(number);
}

const Dialect& dialect_of(LanguageVersion version) {
  static const Dialect k2021(LanguageVersion::k2021), k2026(LanguageVersion::k2026);
  return version == LanguageVersion::k2021 ? k2021 : k2026;
}

std::string filled(std::string_view words, std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) {
    const size_t gap = words.find("{}");
    text += words.substr(0, gap);
    text += part;
    words.remove_prefix(gap + 2);
  }
  return text += words;
}

}  // namespace language
