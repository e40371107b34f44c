#include "modules/node_values.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "language/make.hpp"
#include "values/value_text.hpp"

namespace language {

int integer_or(const BuiltinCall& call, const Value& value, int otherwise) {
  return value.is_number() ? call.environment.dialect.integer(value.number()) : otherwise;
}

std::string str_or_nothing(const Value& value) {
  std::string text;
  if (is_given(value)) append_str_text(text, value);
  return text;
}

bool is_true_bool(const Value& value) { return value.is_bool() && value.boolean(); }

bool is_finite_number(const Value& value) {
  return value.is_number() && std::isfinite(value.number());
}

bool read_vec2(const Value& value, double& x, double& y) {
  if (!value.is_vector()) return false;
  const std::span<const Value> elements = value.elements();
  if (elements.size() != 2 || !elements[0].is_number() || !elements[1].is_number()) return false;
  x = elements[0].number();
  y = elements[1].number();
  return true;
}

bool read_vec3(const Value& value, std::array<double, 3>& xyz, double filler) {
  if (!value.is_vector()) return false;
  const std::span<const Value> elements = value.elements();
  if (elements.size() == 2) {
    read_vec2(value, xyz[0], xyz[1]);
    xyz[2] = filler;
    return true;
  }
  if (elements.size() != 3) return false;
  for (size_t i = 0; i < 3; ++i) {
    if (!elements[i].is_number()) return false;
    xyz[i] = elements[i].number();
  }
  return true;
}

void warn(const BuiltinCall& call, std::string text) {
  call.environment.messages.warn(std::move(text), call.place);
}

void deprecate(const BuiltinCall& call, std::string text) {
  call.environment.messages.say_without_place(MessageGroup::kDeprecated, std::move(text),
                                              call.place);
}

Fragments fragments_of(const BuiltinCall& call) {
  return {number_or(call.fragments_number, 0), number_or(call.fragments_angle, 0),
          number_or(call.fragments_size, 0), number_or(call.fragments_error, 0)};
}

Fragments clamped_fragments(const BuiltinCall& call) {
  constexpr double kLeast = 0.01;
  Fragments fragments = fragments_of(call);
  const auto clamp = [&](double& setting, const char* name) {
    if (!(setting < kLeast)) return;
    warn(call, std::string(name) + " too small - clamping to 0.010000");
    setting = kLeast;
  };
  clamp(fragments.size, "$fs");
  clamp(fragments.angle, "$fa");
  return fragments;
}

void add(NodeTree& tree, ArgumentName name, Value value, ArgumentStyle style) {
  tree.add(name, std::move(value), style);
}

void add_bool(NodeTree& tree, ArgumentName name, bool value) {
  add(tree, name, Value::boolean(value));
}

void add_integer(NodeTree& tree, ArgumentName name, int64_t value) {
  add(tree, name, static_cast<double>(value), ArgumentStyle::kInteger);
}

void add_raw(NodeTree& tree, ArgumentName name, std::string_view text) {
  add(tree, name, make_string(text), ArgumentStyle::kRawString);
}

void add_escaped(NodeTree& tree, ArgumentName name, std::string_view text) {
  add(tree, name, make_string(text), ArgumentStyle::kEscapedString);
}

void add_fragments(NodeTree& tree, const Fragments& fragments) {
  add(tree, "$fn", fragments.number);
  add(tree, "$fa", fragments.angle);
  add(tree, "$fs", fragments.size);
  if (fragments.error > 0) add(tree, "$fe", fragments.error);
}

}  // namespace language
