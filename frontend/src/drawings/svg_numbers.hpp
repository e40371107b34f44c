// Numbers in the attributes of an SVG document, as OpenSCAD 2021.01 reads them.
#pragma once

#include <charconv>
#include <limits>
#include <pugixml.hpp>
#include <string_view>
#include <system_error>

#include "csg/lexer.hpp"

namespace frontend {

/// Returns the number; 0 if the word is none, or has anything behind it. One that exceeds a double
/// is infinite, so that its shape is out of range; OpenSCAD takes it for 0, without a word.
inline double svg_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return 0;
  if (error != std::errc::result_out_of_range) return value;
  const bool is_small = is_below_one(word.substr(word.starts_with('-') ? 1 : 0));
  return is_small ? 0 : std::numeric_limits<double>::infinity();
}

/// Returns the element's attribute as a number, 0 where it is missing.
inline double svg_number(const pugi::xml_node& element, const char* name) {
  return svg_number(element.attribute(name).value());
}

inline bool is_svg_separator(char c) {
  return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

/// Takes the next word between blanks and commas from the front of the text; empty at its end.
inline std::string_view take_svg_word(std::string_view& text) {
  while (!text.empty() && is_svg_separator(text.front())) text.remove_prefix(1);
  size_t length = 0;
  while (length < text.size() && !is_svg_separator(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

}  // namespace frontend
