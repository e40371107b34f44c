#include "values/operators.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "values/tree_map.hpp"

namespace language {
namespace {

void append_types(std::string& out, const Value& left, std::string_view sign, const Value& right) {
  out += '(';
  out += type_name(left.type());
  out += ' ';
  out += sign;
  out += ' ';
  out += type_name(right.type());
  out += ')';
}

Value undefined(const Value& left, std::string_view sign, const Value& right,
                OperatorProblem& problem) {
  problem.text = undefined_operation(left, sign, right);
  return Value::undef();
}

Value undefined(char sign, const Value& operand, OperatorProblem& problem) {
  problem.text = "undefined operation (";
  problem.text += sign;
  problem.text += type_name(operand.type());
  problem.text += ')';
  return Value::undef();
}

// Returns the integer that an operator of bits takes a number for: without its fraction, the
// nearest there is where it is beyond 64 bits, 0 for NaN.
int64_t bits_of(const Value& value) {
  constexpr double kEnd = 9223372036854775808.0;  // 2^63
  const double number = value.number();
  if (std::isnan(number)) return 0;
  if (number >= kEnd) return std::numeric_limits<int64_t>::max();
  if (number < -kEnd) return std::numeric_limits<int64_t>::min();
  return static_cast<int64_t>(number);
}

Value number_of(int64_t bits) { return static_cast<double>(bits); }

template <typename Shift>
Value shifted(const Value& left, std::string_view sign, const Value& right,
              OperatorProblem& problem, Shift shift) {
  if (!are_numbers(left, right)) return undefined(left, sign, right, problem);
  constexpr int64_t kBits = 64;
  const int64_t by = bits_of(right);
  if (by >= 0 && by < kBits) return number_of(shift(bits_of(left), by));
  problem.text = by < 0 ? "negative shift" : "shift too large";
  return Value::undef();
}

// What an operator makes of a pair of numbers within vectors; of any other pair undef, silently.
template <typename Operation>
auto on_numbers(Operation operation) {
  return [operation](const Value& left, const Value& right) {
    if (are_numbers(left, right)) return Value(operation(left.number(), right.number()));
    return Value::undef();
  };
}

// The same for vectors of numbers alone, which most are.
template <typename Operation>
Value map_number_pairs(std::span<const Value> left, std::span<const Value> right,
                       Operation operation) {
  const size_t size = std::min(left.size(), right.size());
  count_work(size);
  NumberWriter result(size);
  for (size_t i = 0; i < size; ++i) result.put(operation(left[i].number(), right[i].number()));
  return result.take();
}

template <typename Operation>
Value elementwise(const Value& left, std::string_view sign, const Value& right,
                  OperatorProblem& problem, Operation operation) {
  if (!left.is_vector() || !right.is_vector()) return undefined(left, sign, right, problem);
  if (left.holds_numbers() && right.holds_numbers())
    return map_number_pairs(left.elements(), right.elements(), operation);
  return map_pairs(left, right, on_numbers(operation));
}

// Returns operation(element) for the numbers of a nested vector, and undef for its other leaves.
template <typename Operation>
Value map_numbers(const Value& vector, Operation operation) {
  return map_leaves(vector, [&](const Value& leaf) {
    return leaf.is_number() ? Value(operation(leaf.number())) : Value::undef();
  });
}

Value scaled(double factor, const Value& vector) {
  return map_numbers(vector, [factor](double number) { return factor * number; });
}

}  // namespace

std::string undefined_operation(const Value& left, std::string_view sign, const Value& right) {
  std::string text = "undefined operation ";
  append_types(text, left, sign, right);
  return text;
}

std::string operation_undefined(const Value& left, std::string_view sign, const Value& right) {
  std::string text = "operation undefined ";
  append_types(text, left, sign, right);
  return text;
}

namespace operators {

Value add(const Value& left, const Value& right, OperatorProblem& problem) {
  return elementwise(left, "+", right, problem, [](double a, double b) { return a + b; });
}

Value subtract(const Value& left, const Value& right, OperatorProblem& problem) {
  return elementwise(left, "-", right, problem, [](double a, double b) { return a - b; });
}

Value multiply(const Value& left, const Value& right, OperatorProblem& problem) {
  if (left.is_number() && right.is_vector()) return scaled(left.number(), right);
  if (left.is_vector() && right.is_number()) return scaled(right.number(), left);
  if (left.is_vector() && right.is_vector()) return multiply_vectors(left, right, problem);
  return undefined(left, "*", right, problem);
}

Value divide(const Value& left, const Value& right, OperatorProblem& problem) {
  if (left.is_vector() && right.is_number())
    return map_numbers(left, [&](double number) { return number / right.number(); });
  if (left.is_number() && right.is_vector())
    return map_numbers(right, [&](double number) { return left.number() / number; });
  return undefined(left, "/", right, problem);
}

Value modulo(const Value& left, const Value& right, OperatorProblem& problem) {
  return undefined(left, "%", right, problem);
}

Value power(const Value& left, const Value& right, OperatorProblem& problem) {
  return undefined(left, "^", right, problem);
}

Value negate(const Value& operand, OperatorProblem& problem) {
  if (operand.is_vector()) return map_numbers(operand, [](double number) { return -number; });
  return undefined('-', operand, problem);
}

Value shift_left(const Value& left, const Value& right, OperatorProblem& problem) {
  return shifted(left, "<<", right, problem, [](int64_t bits, int64_t by) {
    return static_cast<int64_t>(static_cast<uint64_t>(bits) << by);
  });
}

Value shift_right(const Value& left, const Value& right, OperatorProblem& problem) {
  return shifted(left, ">>", right, problem, [](int64_t bits, int64_t by) { return bits >> by; });
}

Value bit_and(const Value& left, const Value& right, OperatorProblem& problem) {
  if (!are_numbers(left, right)) return undefined(left, "&", right, problem);
  return number_of(bits_of(left) & bits_of(right));
}

Value bit_or(const Value& left, const Value& right, OperatorProblem& problem) {
  if (!are_numbers(left, right)) return undefined(left, "|", right, problem);
  return number_of(bits_of(left) | bits_of(right));
}

Value complement(const Value& operand, OperatorProblem& problem) {
  if (!operand.is_number()) return undefined('~', operand, problem);
  return number_of(~bits_of(operand));
}

}  // namespace operators
}  // namespace language
