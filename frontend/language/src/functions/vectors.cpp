#include <array>
#include <cmath>
#include <utility>

#include "functions/builtin_functions.hpp"
#include "language/make.hpp"
#include "values/members_object.hpp"

namespace language::functions {
namespace {

double number_or_zero(const Value& value) { return value.is_number() ? value.number() : 0; }

Value cross_2d(std::span<const Value> a, std::span<const Value> b) {
  return number_or_zero(a[0]) * number_or_zero(b[1]) - number_or_zero(a[1]) * number_or_zero(b[0]);
}

// Returns what is wrong with a pair of coordinates, or an empty text.
std::string_view problem_of(const Value& a, const Value& b) {
  if (!a.is_number() || !b.is_number()) return "Invalid value in parameter vector";
  const double x = a.number(), y = b.number();
  if (std::isnan(x) || std::isnan(y)) return "Invalid value (NaN) in parameter vector";
  if (std::isinf(x) || std::isinf(y)) return "Invalid value (INF) in parameter vector";
  return {};
}

Value cross_3d(std::span<const Value> a, std::span<const Value> b) {
  const auto minor = [&](int i, int j) {
    return Value(a[i].number() * b[j].number() - a[j].number() * b[i].number());
  };
  const std::array<Value, 3> product = {minor(1, 2), minor(2, 0), minor(0, 1)};
  return make_vector(product);
}

Value refuse_cross(const FunctionCall& call, std::string_view problem) {
  call.warn(std::string(problem) + " for cross()");
  return Value::undef();
}

}  // namespace

Value no_vector(const FunctionCall& call, size_t argument) {
  if (!call.environment.dialect.tells_missing_vectors) return Value::undef();
  return not_converted(call, argument, "vector");
}

Value norm(const FunctionCall& call) {
  if (!call.arguments[0].is_vector()) return no_vector(call, 0);
  double sum = 0;
  for (const Value& element : call.arguments[0].elements()) {
    if (!element.is_number()) {
      call.warn("Incorrect arguments to norm()");
      return Value::undef();
    }
    sum += element.number() * element.number();
  }
  return std::sqrt(sum);
}

Value cross(const FunctionCall& call) {
  const auto arguments = call.arguments;
  if (call.written != 2) return refuse_cross(call, "Invalid number of parameters");
  for (const size_t number : {0, 1}) {
    if (arguments[number].is_vector()) continue;
    if (call.environment.dialect.tells_missing_vectors) return no_vector(call, number);
    return refuse_cross(call, "Invalid type of parameters");
  }
  const auto a = arguments[0].elements(), b = arguments[1].elements();
  if (a.size() == 2 && b.size() == 2) return cross_2d(a, b);
  if (a.size() != 3 || b.size() != 3) return refuse_cross(call, "Invalid vector size of parameter");
  for (size_t i = 0; i < 3; ++i)
    if (const auto problem = problem_of(a[i], b[i]); !problem.empty())
      return refuse_cross(call, problem);
  return cross_3d(a, b);
}

Value length(const FunctionCall& call) {
  const Value& argument = call.arguments[0];
  if (argument.is_vector()) return static_cast<double>(argument.elements().size());
  if (argument.is_object()) return static_cast<double>(argument.members().size());
  if (!argument.is_string()) return not_converted(call, 0, "string");
  return static_cast<double>(static_cast<const StringObject&>(*argument.object()).code_points);
}

Value concatenation(const FunctionCall& call) {
  size_t size = 0;
  for (const Value& argument : call.arguments)
    size += argument.is_vector() ? argument.elements().size() : 1;
  // A first vector that nothing else refers to is appended to in place.
  auto rest = call.arguments;
  Value result;
  if (!rest.empty() && rest[0].is_vector() && rest[0].is_unique()) {
    result = std::move(rest[0]);
    rest = rest.subspan(1);
  } else {
    result = make_vector(size);
  }
  for (Value& argument : rest) {
    if (argument.is_vector())
      append_elements(result, argument.elements());
    else
      append_element(result, std::move(argument));
  }
  return result;
}

}  // namespace language::functions
