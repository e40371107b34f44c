// Numbers as text.
#pragma once

#include <charconv>
#include <string>
#include <vector>

#include "csgcore/geometry.hpp"

namespace oracle {

/// Returns the shortest decimal that reads as the same double.
inline std::string shortest_text(double number) {
  char text[32];  // the longest is "-2.2250738585072014e-308"
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

/// These return the parts as "a, b, c".
inline std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}
inline std::string joined(const std::vector<double>& numbers) {
  std::vector<std::string> parts;
  for (const double number : numbers) parts.push_back(shortest_text(number));
  return joined(parts);
}
inline std::string coordinates(const csgcore::Vec3& v) { return joined({v.x, v.y, v.z}); }

}  // namespace oracle
