#include <algorithm>
#include <cmath>
#include <string>

#include "functions/builtin_functions.hpp"
#include "language/degrees.hpp"
#include "values/operators.hpp"

namespace language::functions {
namespace {

template <typename Operation>
Value of_number(const FunctionCall& call, Operation operation) {
  const Value& argument = call.arguments[0];
  return argument.is_number() ? Value(operation(argument.number())) : not_converted(call);
}

template <typename Operation>
Value of_numbers(const FunctionCall& call, Operation operation) {
  const Value &first = call.arguments[0], &second = call.arguments[1];
  if (!are_numbers(first, second)) return not_converted(call);
  return operation(first.number(), second.number());
}

double sign_of(double number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

bool are_all_numbers(std::span<const Value> values) {
  return std::all_of(values.begin(), values.end(),
                     [](const Value& value) { return value.is_number(); });
}

// Returns whether an element comes before another; those that cannot be compared do not.
bool is_before(const Value& left, const Value& right) {
  if (are_numbers(left, right)) return left.number() < right.number();
  OperatorProblem ignored;
  return operators::less(left, right, ignored).is_true();
}

// Calls `select` with what min() and max() choose from: numbers, or the elements of one vector.
template <typename Select>
Value extreme(const FunctionCall& call, Select select) {
  if (are_all_numbers(call.arguments)) return select(call.arguments);
  if (call.written > 1 || !call.arguments[0].is_vector()) return not_converted(call);
  const auto elements = call.arguments[0].elements();
  return elements.empty() ? not_converted(call) : select(elements);
}

}  // namespace

Value not_converted(const FunctionCall& call) {
  call.warn(std::string(call.name) + "() parameter could not be converted");
  return Value::undef();
}

Value absolute(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::abs(x); });
}
Value sign(const FunctionCall& call) { return of_number(call, sign_of); }
Value floor(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::floor(x); });
}
Value ceiling(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::ceil(x); });
}
Value round(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::round(x); });
}
Value square_root(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::sqrt(x); });
}
Value exponential(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::exp(x); });
}
Value natural_logarithm(const FunctionCall& call) {
  return of_number(call, [](double x) { return std::log(x); });
}
Value sine(const FunctionCall& call) { return of_number(call, sine_of_degrees); }
Value cosine(const FunctionCall& call) { return of_number(call, cosine_of_degrees); }
Value tangent(const FunctionCall& call) { return of_number(call, tangent_of_degrees); }
Value arc_sine(const FunctionCall& call) { return of_number(call, arc_sine_degrees); }
Value arc_cosine(const FunctionCall& call) { return of_number(call, arc_cosine_degrees); }
Value arc_tangent(const FunctionCall& call) {
  return of_number(call, [](double x) { return arc_tangent_degrees(x); });
}
Value arc_tangent_of_two(const FunctionCall& call) {
  return of_numbers(call, [](double y, double x) { return arc_tangent_degrees(y, x); });
}
Value power(const FunctionCall& call) {
  return of_numbers(call, [](double base, double exponent) { return std::pow(base, exponent); });
}

Value logarithm(const FunctionCall& call) {
  if (call.arguments.size() == 1)
    return of_number(call, [](double x) { return std::log(x) / std::log(10.0); });
  return of_numbers(call, [](double base, double x) { return std::log(x) / std::log(base); });
}

Value minimum(const FunctionCall& call) {
  return extreme(call, [](std::span<const Value> values) {
    return *std::min_element(values.begin(), values.end(), is_before);
  });
}

Value maximum(const FunctionCall& call) {
  return extreme(call, [](std::span<const Value> values) {
    return *std::max_element(values.begin(), values.end(), is_before);
  });
}

}  // namespace language::functions
