#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/evaluation_thread.hpp"
#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "functions/builtin_functions.hpp"
#include "language/make.hpp"
#include "values/object_memory.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language::functions {
namespace {

constexpr uint32_t kMostRangeValues = 10000;  // chr() ignores ranges of so many and more

void append_character(std::string& out, double number, const Dialect& dialect) {
  const uint32_t code_point = number > 0 ? dialect.unsigned_integer(number) : 0;
  if (code_point != 0 && is_code_point(code_point)) append_code_point(out, code_point);
}

void append_range_characters(std::string& out, const RangeObject& range, const Dialect& dialect) {
  if (range.count() >= kMostRangeValues) return;
  const uint32_t steps = range.steps();
  count_work(steps);
  for (uint32_t i = 0; i < steps; ++i) append_character(out, range.value(i), dialect);
}

// Calls `visit` for the elements of a vector that are no vectors, or for the one value. Vectors may
// nest deeply.
template <typename Visit>
void visit_leaves(const Value& value, Visit visit) {
  std::vector<std::span<const Value>> rests{{&value, 1}};
  while (!rests.empty()) {
    count_work();
    auto& rest = rests.back();
    if (rest.empty()) {
      rests.pop_back();
      continue;
    }
    const Value& element = rest.front();
    rest = rest.subspan(1);
    if (element.is_vector())
      rests.push_back(element.elements());
    else
      visit(element);
  }
}

void append_characters(std::string& out, const Value& value, const Dialect& dialect) {
  visit_leaves(value, [&](const Value& leaf) {
    if (leaf.is_number()) append_character(out, leaf.number(), dialect);
    if (leaf.is_range()) append_range_characters(out, leaf.range(), dialect);
    check_text_size(out.size());
  });
}

void warn_of_long_ranges(const Value& value, Messages& messages) {
  visit_leaves(value, [&](const Value& leaf) {
    if (!leaf.is_range() || leaf.range().count() < kMostRangeValues) return;
    messages.say(MessageGroup::kWarning,
                 "Bad range parameter in for statement: too many elements (" +
                     std::to_string(leaf.range().count()) + ").");
  });
}

}  // namespace

Value string(const FunctionCall& call) {
  std::string text;
  for (const Value& argument : call.arguments) append_str_text(text, argument);
  return make_string(text);
}

size_t next_of_characters(const FunctionCall& call) {
  const auto arguments = call.arguments;
  if (!arguments.empty()) warn_of_long_ranges(arguments.back(), call.environment.messages);
  return arguments.size() < call.written ? arguments.size() : kNoArgument;
}

Value characters(const FunctionCall& call) {
  std::string text;
  if (!call.environment.dialect.has_lazy_functions) {
    for (const Value& argument : call.arguments)
      warn_of_long_ranges(argument, call.environment.messages);
  }
  for (const Value& argument : call.arguments)
    append_characters(text, argument, call.environment.dialect);
  return make_string(text);
}

Value code_point(const FunctionCall& call) {
  if (call.written == 0) return Value::undef();
  const auto refuse = [&](std::string text) {
    call.warn("ord() " + std::move(text));
    return Value::undef();
  };
  if (call.written > 1)
    return refuse("called with " + std::to_string(call.written) +
                  " arguments, only 1 argument expected");
  const Value& argument = call.arguments[0];
  if (!argument.is_string() && call.environment.dialect.tells_wrong_arguments)
    return not_converted(call, 0, "string");
  if (!argument.is_string())
    return refuse("argument " + echo_text(argument) + " is not of type string");
  const std::string_view text = argument.text();
  if (!is_valid_utf8(text))
    return refuse("argument '" + std::string(text) + "' is not a valid utf8 string");
  return text.empty() ? Value::undef() : Value(first_code_point(text));
}

}  // namespace language::functions
