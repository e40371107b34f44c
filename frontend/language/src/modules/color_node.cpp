// color().
#include <array>
#include <cstdio>
#include <optional>

#include "language/color_names.hpp"
#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

using Rgba = std::array<float, 4>;

/// What a node has whose color() names none: red, green and blue of the scheme, and in 2026 its
/// alpha, too.
Rgba no_color(const BuiltinCall& call) {
  return {-1, -1, -1, call.environment.dialect.checks_alpha ? -1.0F : 1.0F};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

void check_channel(const BuiltinCall& call, float channel, std::string_view what = "numbers") {
  if (!(channel < 0 || channel > 1)) return;
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.1f", static_cast<double>(channel));
  warn(call, "color() expects " + std::string(what) + " between 0.0 and 1.0. Value of " +
                 std::string(text.data()) + " is out of range");
}

Rgba color_of_vector(const BuiltinCall& call, std::span<const Value> channels) {
  Rgba color = {1, 1, 1, 1};
  for (size_t i = 0; i < std::min(channels.size(), color.size()); ++i) {
    color[i] = static_cast<float>(number_or(channels[i], 0));
    check_channel(call, color[i]);
  }
  return color;
}

Rgba color_of_text(const BuiltinCall& call, std::string_view name) {
  const std::optional<Rgba> color = color_of_name(name, call.environment.dialect.has_survey_colors);
  if (color) return *color;
  const bool tells_more = call.environment.dialect.tells_of_web_colors;
  warn(call,
       "Unable to parse color \"" + (tells_more ? lower_case(name) : std::string(name)) + "\"");
  if (tells_more)
    call.environment.messages.say(MessageGroup::kPlain,
                                  "Please see https://en.wikipedia.org/wiki/Web_colors");
  return no_color(call);
}

}  // namespace

Made make_color(const BuiltinCall& call, NodeTree& tree) {
  const Value& c = call.parameters[0];
  const Value& alpha = call.parameters[1];
  set_kind(tree, NodeKind::kColor);
  Rgba color = no_color(call);
  if (c.is_vector()) color = color_of_vector(call, c.elements());
  if (c.is_string()) color = color_of_text(call, c.text());
  if (alpha.is_number()) {
    color[3] = static_cast<float>(alpha.number());
    if (call.environment.dialect.checks_alpha) check_channel(call, color[3], "alpha");
  }
  add_numbers(tree, "", {color[0], color[1], color[2], color[3]});
  return Made::kNode;
}

}  // namespace language
