#include <cmath>
#include <optional>

#include "base/utf8.hpp"
#include "language/make.hpp"
#include "values/members_object.hpp"
#include "values/operators.hpp"
#include "values/range.hpp"

namespace language {
namespace {

// Returns the position that an index means, or nothing where it lies outside of all containers.
std::optional<uint32_t> position_of(const Value& index) {
  constexpr double kEnd = 4294967296.0;
  if (!index.is_number()) return std::nullopt;
  const double position = std::trunc(index.number());
  if (!(position >= 0 && position < kEnd)) return std::nullopt;
  return static_cast<uint32_t>(position);
}

Value character_at(const Value& string, uint32_t position) {
  const auto& object = static_cast<const StringObject&>(*string.object());
  if (position >= object.code_points) return Value::undef();
  const std::string_view text = string.text();
  if (object.code_points == object.size) return make_string(text.substr(position, 1));
  const std::string_view rest = text.substr(code_point_offset(text, position));
  return make_string(rest.substr(0, code_point_length(rest)));
}

Value range_part(const RangeObject& range, uint32_t position) {
  switch (position) {
    case 0:
      return range.begin;
    case 1:
      return range.step;
    case 2:
      return range.end;
    default:
      return Value::undef();
  }
}

Value member_of(const MembersObject& object, std::string_view name) {
  const Value* const found = object.find(name);
  return found ? *found : Value::undef();
}

Value element(const Value& vector, uint32_t position) {
  const auto elements = vector.elements();
  return position < elements.size() ? elements[position] : Value::undef();
}

}  // namespace

Value operators::index(const Value& container, const Value& index) {
  if (container.is_object() && index.is_string())
    return member_of(container.members(), index.text());
  const auto position = position_of(index);
  if (!position) return Value::undef();
  switch (container.type()) {
    case ValueType::kVector:
      return element(container, *position);
    case ValueType::kString:
      return character_at(container, *position);
    case ValueType::kRange:
      return range_part(container.range(), *position);
    default:
      return Value::undef();
  }
}

namespace {

/// Returns the elements of a vector that the letters of a name mean, if all are of one alphabet.
Value swizzle(const Value& vector, std::string_view name) {
  for (const std::string_view letters : {"xyzw", "rgba"}) {
    if (name.empty() || name.size() > letters.size() ||
        name.find_first_not_of(letters) != name.npos)
      continue;
    const auto selected = [&](char letter) {
      return element(vector, static_cast<uint32_t>(letters.find(letter)));
    };
    if (name.size() == 1) return selected(name.front());
    Value elements = make_vector(name.size());
    for (const char letter : name) append_element(elements, selected(letter));
    return elements;
  }
  return Value::undef();
}

}  // namespace

Value member(const Value& container, std::string_view name, const Dialect& dialect) {
  if (container.is_vector() && dialect.has_swizzles) return swizzle(container, name);
  if (container.is_vector() && name.size() == 1) {
    const size_t position = std::string_view("xyz").find(name);
    if (position != std::string_view::npos)
      return element(container, static_cast<uint32_t>(position));
  }
  if (container.is_object()) return member_of(container.members(), name);
  if (container.is_range()) {
    if (name == "begin") return container.range().begin;
    if (name == "step") return container.range().step;
    if (name == "end") return container.range().end;
  }
  return Value::undef();
}

}  // namespace language
