// Numbers in the attributes of an SVG document, as OpenSCAD 2021.01 reads them.
#pragma once

#include <charconv>
#include <pugixml.hpp>
#include <string_view>
#include <system_error>

namespace frontend {

/// Returns the number; 0 if the word is none, or has anything behind it, or exceeds a double.
inline double svg_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return 0;
  return value;
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
