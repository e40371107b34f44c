// Numbers in the texts of imported files.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "csg/lexer.hpp"
#include "csgcore/stop_scope.hpp"

namespace frontend {

/// Returns the number if the whole word is one, perhaps inf or nan. As to OpenSCAD, a word is none
/// if its number is larger than the largest double; one that is too small for a double is 0.
inline std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error != std::errc::result_out_of_range) return value;
  if (!is_below_one(word.substr(word.starts_with('-') ? 1 : 0))) return std::nullopt;
  return 0;
}

/// Returns the index if the whole word is one.
inline std::optional<uint32_t> index_of(std::string_view word) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the next word from the front of the text; empty at its end.
inline std::string_view take_word(std::string_view& text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  size_t length = 0;
  while (length < text.size() && !is_blank(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

/// Takes the next line, without its end, from the front of the text.
inline std::string_view take_line(std::string_view& text) {
  csgcore::stop_point();
  const size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace frontend
