#include <algorithm>
#include <cmath>
#include <string>

#include "functions/builtin_functions.hpp"
#include "language/degrees.hpp"
#include "values/operators.hpp"
#include "values/value_text.hpp"

namespace language::functions {
namespace {

template <typename Operation>
Value of_number(const FunctionCall& call, Operation operation) {
  const Value& argument = call.arguments[0];
  return argument.is_number() ? Value(operation(argument.number())) : no_number(call);
}

template <typename Operation>
Value of_numbers(const FunctionCall& call, Operation operation) {
  const Value &first = call.arguments[0], &second = call.arguments[1];
  if (!are_numbers(first, second)) return no_number(call);
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

/// Warns that a value, an argument or an element of one, is not of the type that is expected.
Value refuse(const FunctionCall& call, const std::string& what, std::string_view expected,
             const Value& found) {
  std::string text = std::string(call.name) + "() parameter could not be converted";
  if (call.environment.dialect.tells_wrong_arguments) {
    text += ": " + what + ": expected " + std::string(expected) + ", found " +
            std::string(type_name(found.type())) + " (" + echo_text(found) + ")";
  }
  call.warn(std::move(text));
  return Value::undef();
}

Value no_elements(const FunctionCall& call) {
  if (!call.environment.dialect.tells_wrong_arguments) return no_number(call);
  call.warn(std::string(call.name) +
            "() number of parameters does not match: expected at least 1 vector element, found 0");
  return Value::undef();
}

// Calls `select` with what min() and max() choose from: numbers, or the elements of one vector.
template <typename Select>
Value extreme(const FunctionCall& call, Select select) {
  if (are_all_numbers(call.arguments)) return select(call.arguments);
  if (call.written > 1 || !call.arguments[0].is_vector()) return no_number(call);
  const auto elements = call.arguments[0].elements();
  if (elements.empty()) return no_elements(call);
  const auto wrong = std::find_if(elements.begin(), elements.end(),
                                  [](const Value& element) { return !element.is_number(); });
  if (call.environment.dialect.compares_any_elements || wrong == elements.end())
    return select(elements);
  return refuse(call, "vector element " + std::to_string(wrong - elements.begin()), "number",
                *wrong);
}

}  // namespace

Value not_converted(const FunctionCall& call, size_t argument, std::string_view expected) {
  return refuse(call, "argument " + std::to_string(argument), expected, call.arguments[argument]);
}

Value no_number(const FunctionCall& call) {
  const auto wrong = std::find_if(call.arguments.begin(), call.arguments.end(),
                                  [](const Value& argument) { return !argument.is_number(); });
  return not_converted(call, static_cast<size_t>(wrong - call.arguments.begin()), "number");
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
Value tangent(const FunctionCall& call) {
  const bool has_nearest_integers = call.environment.dialect.has_nearest_integers;
  return of_number(call, [=](double x) { return tangent_of_degrees(x, has_nearest_integers); });
}
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
