// What differs between the versions of OpenSCAD's language: a table, each row with the behaviour of
// 2021.01, the last release, beside that of 2026, the development snapshots (LANGUAGE.md,
// "Dialects"). Each row is read in one place.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "language/language_version.hpp"

namespace language {

class Dialect {
 public:
  explicit constexpr Dialect(LanguageVersion of) : version(of) {}

  const LanguageVersion version;

 private:
  template <typename Behaviour>
  constexpr Behaviour row(Behaviour of_2021, Behaviour of_2026) const {
    return version == LanguageVersion::k2021 ? of_2021 : of_2026;
  }
  constexpr std::string_view words(std::string_view of_2021, std::string_view of_2026) const {
    return row(of_2021, of_2026);
  }

 public:
  // Text

  /// Whether `0x1F` is a number; else it is a name.
  const bool has_hexadecimal_numbers = row(false, true);
  /// Whether it is said that a whole number is none that a double can hold.
  const bool tells_imprecise_integers = row(false, true);
  /// Whether names that begin with a digit are deprecated.
  const bool deprecates_digits_first = row(false, true);
  /// Whether it is said that a backslash begins no escape.
  const bool tells_undefined_escapes = row(false, true);
  /// Whether line ends within the brackets of `include` and `use` are counted, and warned of.
  const bool counts_lines_of_paths = row(false, true);

  // Grammar

  /// Whether commas may be doubled, and stand before the first parameter or element. One may stand
  /// behind the last one, whatever it is.
  const bool has_doubled_commas = row(true, false);
  /// Whether a vector's first element may be a comprehension in parentheses.
  const bool has_comprehension_first = row(false, true);

  // Words, with {} for what they speak of

  const std::string_view overwritten =
      words("{} was assigned on line {}{} but was overwritten",
            "\"{}\" was assigned on line {}{} but was overwritten");
};

/// Returns the dialect of a version, which lasts.
const Dialect& dialect_of(LanguageVersion version);

/// Returns words with each {} replaced by the next of the parts.
std::string filled(std::string_view words, std::initializer_list<std::string_view> parts);

}  // namespace language
