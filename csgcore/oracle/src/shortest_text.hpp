// Numbers as text.
#pragma once

#include <charconv>
#include <string>

namespace oracle {

/// The shortest decimal that reads as the same double.
inline std::string shortest_text(double number) {
  char text[32];  // the longest is "-2.2250738585072014e-308"
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

}  // namespace oracle
