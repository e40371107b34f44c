#include "base/dialect.hpp"

namespace language {

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
