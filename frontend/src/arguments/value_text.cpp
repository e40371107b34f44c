#include "arguments/value_text.hpp"

#include <algorithm>

#include "arguments/node_reader.hpp"

namespace frontend {

std::optional<Vec2> pair_of(const ArgumentValue& value) {
  if (!value.is_list()) return std::nullopt;
  const ValueList elements = value.elements();
  if (elements.size() != 2 || !elements[0].is_number() || !elements[1].is_number()) {
    return std::nullopt;
  }
  return Vec2(elements[0].number(), elements[1].number());
}

std::optional<csgcore::Vec3> vector_of(const ArgumentValue& list, size_t fewest) {
  if (!list.is_list()) return std::nullopt;
  const ValueList numbers = list.elements();
  if (numbers.size() < fewest || numbers.size() > 3) return std::nullopt;
  csgcore::Vec3 result(0.0);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (!numbers[i].is_number()) return std::nullopt;
    result[static_cast<int>(i)] = numbers[i].number();
  }
  return result;
}

std::string printed_text(const ArgumentValue& value) {
  if (value.is_string()) return '"' + std::string(value.text()) + '"';
  if (!value.is_list()) return scalar_text(value);
  std::string text = "[";
  for (const ArgumentValue element : value.elements()) {
    if (text.size() > 1) text += ", ";
    // No point holds lists; what is deeper does not matter.
    text += element.is_list() ? "[...]" : printed_text(element);
  }
  return text + "]";
}

namespace {

/// A value as OpenSCAD writes it, but for what is long: strings, long lists and lists in lists.
std::string short_text(const ArgumentValue& value, bool is_inner) {
  constexpr size_t kMostElements = 8, kLongestString = 40;
  if (value.is_string()) {
    return '"' + std::string(value.text().substr(0, kLongestString)) + '"';
  }
  if (!value.is_list()) return scalar_text(value);
  const ValueList elements = value.elements();
  if (is_inner && !elements.empty()) return "[...]";
  std::string text = "[";
  for (size_t i = 0; i < std::min(elements.size(), kMostElements); ++i) {
    text += (i > 0 ? ", " : "") + short_text(elements[i], true);
  }
  return text + (elements.size() > kMostElements ? ", ...]" : "]");
}

}  // namespace

std::string short_text(const ArgumentValue& value) { return short_text(value, false); }

}  // namespace frontend
