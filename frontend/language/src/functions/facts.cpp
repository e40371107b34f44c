#include <array>
#include <climits>
#include <cmath>
#include <string>

#include "functions/builtin_functions.hpp"
#include "language/make.hpp"

namespace language::functions {
namespace {

Value combined(double year, double month, double day) { return year * 10000 + month * 100 + day; }

}  // namespace

Value version(const FunctionCall& call) {
  const auto& [year, month, day] = call.environment.dialect.program;
  const std::array<Value, 3> parts = {year, month, day};
  return make_vector(parts);
}

Value version_number(const FunctionCall& call) {
  const auto& [year, month, day] = call.environment.dialect.program;
  if (call.arguments.empty()) return combined(year, month, day);
  const Value& argument = call.arguments[0];
  if (!argument.is_vector()) return Value::undef();
  const auto parts = argument.elements();
  if (parts.size() < 2 || parts.size() > 3) return Value::undef();
  for (const Value& part : parts)
    if (!part.is_number()) return Value::undef();
  return combined(parts[0].number(), parts[1].number(), parts.size() > 2 ? parts[2].number() : 0);
}

Value is_list(const FunctionCall& call) { return Value::boolean(call.arguments[0].is_vector()); }
Value is_bool(const FunctionCall& call) { return Value::boolean(call.arguments[0].is_bool()); }
Value is_string(const FunctionCall& call) { return Value::boolean(call.arguments[0].is_string()); }
Value is_function(const FunctionCall& call) {
  return Value::boolean(call.arguments[0].is_function());
}
Value is_number(const FunctionCall& call) {
  const Value& argument = call.arguments[0];
  return Value::boolean(argument.is_number() && !std::isnan(argument.number()));
}

Value parent_module(const FunctionCall& call) {
  const bool is_wrong = !call.arguments.empty() && !call.arguments[0].is_number();
  if (is_wrong && call.environment.dialect.tells_wrong_arguments) return no_number(call);
  if (is_wrong) return Value::undef();
  const int level =
      call.arguments.empty() ? 1 : call.environment.dialect.integer(call.arguments[0].number());
  const auto refuse = [&](std::string_view before, std::string_view after) {
    call.warn(std::string(before) + "arent module index (" + std::to_string(level) + ") " +
              std::string(after));
    return Value::undef();
  };
  const auto& modules = call.environment.module_names;
  if (level < 0) return refuse("Negative p", "not allowed");
  if (static_cast<size_t>(level) >= modules.size())
    return refuse("P", "greater than the number of modules on the stack");
  return make_string(modules[modules.size() - 1 - static_cast<size_t>(level)]);
}

}  // namespace language::functions
