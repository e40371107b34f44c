// textmetrics() and fontmetrics().
#include <array>
#include <string>

#include "functions/builtin_functions.hpp"
#include "functions/text_parameters.hpp"
#include "language/make.hpp"
#include "values/members_object.hpp"
#include "values/parameter_values.hpp"

namespace language::functions {
namespace {

struct AlignmentWords {
  std::string_view parameter, listed;
  std::array<std::string_view, 5> known;
};
constexpr AlignmentWords kHorizontal = {
    "halign", R"("left", "right" or "center")", {"default", "left", "right", "center"}};
constexpr AlignmentWords kVertical = {"valign",
                                      R"("baseline", "bottom", "top" or "center")",
                                      {"default", "baseline", "bottom", "top", "center"}};

void check_alignment(const FunctionCall& call, const AlignmentWords& words,
                     const std::string& given) {
  for (const std::string_view word : words.known)
    if (!word.empty() && given == word) return;
  call.warn("Unknown value for the " + std::string(words.parameter) + " parameter (use " +
            std::string(words.listed) + "): '" + given + "'");
}

Value no_font(const FunctionCall& call, const std::string& font) {
  call.warn("Can't get font " + font);
  return Value::undef();
}

Value pair_of(const std::array<double, 2>& pair) {
  const std::array<Value, 2> elements = {pair[0], pair[1]};
  return make_vector(elements);
}

/// Returns { ascent; descent; }.
Value extent(double ascent, double descent) {
  ObjectWriter object;
  object.set("ascent", ascent);
  object.set("descent", descent);
  return object.take();
}

}  // namespace

Value text_metrics(const FunctionCall& call) {
  check_text_types(call.name, call.arguments,
                   [&](std::string text) { call.warn(std::move(text)); });
  const TextRequest text = text_request(call.arguments, "default", "default");
  TextMeter* const meter = call.environment.text_meter;
  const auto metrics = meter ? meter->measure(text, call.environment.fonts) : std::nullopt;
  if (!metrics) return no_font(call, text.font);
  if (metrics->has_ink) check_alignment(call, kHorizontal, text.halign);
  if (metrics->has_ink) check_alignment(call, kVertical, text.valign);
  ObjectWriter object;
  object.set("position", pair_of(metrics->position));
  object.set("size", pair_of(metrics->size));
  object.set("ascent", metrics->ascent);
  object.set("descent", metrics->descent);
  object.set("offset", pair_of(metrics->offset));
  object.set("advance", pair_of(metrics->advance));
  return object.take();
}

Value font_metrics(const FunctionCall& call) {
  const Value &size = call.arguments[0], &font = call.arguments[1];
  if (is_given(size) && !size.is_number()) call.warn(wrong_type(call.name, "size", "number", size));
  if (is_given(font) && !font.is_string()) call.warn(wrong_type(call.name, "font", "string", font));
  const std::string name(text_or(font, ""));
  TextMeter* const meter = call.environment.text_meter;
  const auto metrics =
      meter ? meter->measure_font(name, number_or(size, 10), call.environment.fonts) : std::nullopt;
  if (!metrics) return no_font(call, name);
  ObjectWriter names, object;
  names.set("family", make_string(metrics->family));
  names.set("style", make_string(metrics->style));
  object.set("nominal", extent(metrics->ascent, metrics->descent));
  object.set("max", extent(metrics->most_ascent, metrics->most_descent));
  object.set("interline", metrics->line_distance);
  object.set("font", names.take());
  return object.take();
}

}  // namespace language::functions
