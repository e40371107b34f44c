#include "values/operators.hpp"

#include <gtest/gtest.h>

#include "language/make.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

using namespace operators;
using Operator = Value (*)(const Value&, const Value&, OperatorProblem&);

Value list(std::initializer_list<Value> elements) {
  return make_vector(std::span(elements.begin(), elements.size()));
}

Value text(std::string_view characters) { return make_string(characters); }

// Returns the result as echo() shows it, and what is said: "undef | undefined operation (…)".
std::string result(Operator operation, const Value& left, const Value& right) {
  OperatorProblem problem;
  std::string shown = echo_text(operation(left, right, problem));
  if (!problem.unplaced.empty()) shown += " || " + problem.unplaced;
  if (!problem.text.empty()) shown += " | " + problem.text;
  return shown;
}

const Value kNan = 0.0 / 0.0;

TEST(Operators, WorkOnVectors) {
  EXPECT_EQ(result(add, list({1, text("b")}), list({1, 2, 3})), "[2, undef]");
  EXPECT_EQ(result(subtract, list({list({1}), 2}), list({list({3}), 5})), "[[-2], -3]");
  EXPECT_EQ(result(multiply, 2, list({1, list({2, text("a")})})), "[2, [4, undef]]");
  EXPECT_EQ(result(divide, list({1, 2}), 2), "[0.5, 1]");
  EXPECT_EQ(result(divide, 2, list({1, list({4})})), "[2, [0.5]]");
}

TEST(Operators, SayWhichTypesTheyRefuse) {
  EXPECT_EQ(result(add, text("a"), 1), "undef | undefined operation (string + number)");
  EXPECT_EQ(result(subtract, 1, list({2})), "undef | undefined operation (number - vector)");
  EXPECT_EQ(result(multiply, Value::boolean(true), 2),
            "undef | undefined operation (bool * number)");
  EXPECT_EQ(result(divide, list({1}), list({1})), "undef | undefined operation (vector / vector)");
  EXPECT_EQ(result(modulo, list({1}), 2), "undef | undefined operation (vector % number)");
  EXPECT_EQ(result(power, 2, Value()), "undef | undefined operation (number ^ undefined)");
  OperatorProblem problem;
  EXPECT_TRUE(negate(make_range(0, 1, 2), problem).is_undef());
  EXPECT_EQ(problem.text, "undefined operation (-range)");
}

// The results and the warnings are those of OpenSCAD 2025.07.18.
TEST(Operators, WorkOnBits) {
  const auto complement = [](const Value& operand) {
    OperatorProblem problem;
    std::string shown = echo_text(operators::complement(operand, problem));
    return problem.text.empty() ? shown : shown + " | " + problem.text;
  };
  const double infinity = 1.0 / 0.0, too_large = 1e30;
  EXPECT_EQ(result(bit_and, 12, 5), "4");
  EXPECT_EQ(result(bit_or, 12, 5), "13");
  EXPECT_EQ(result(shift_left, 2, 3), "16");
  EXPECT_EQ(result(shift_right, 16, 2), "4");
  EXPECT_EQ(complement(5), "-6");
  EXPECT_EQ(result(bit_and, 5.7, 3.9), "1") << "without the fractions";
  EXPECT_EQ(result(bit_or, -5.7, 0), "-5");
  EXPECT_EQ(complement(-5.7), "4");
  EXPECT_EQ(result(shift_right, -8, 2), "-2");
  EXPECT_EQ(result(shift_left, 1, 63.9), "-9.22337e+18");
  EXPECT_EQ(result(shift_left, 1, -0.5), "1");
  EXPECT_EQ(result(bit_and, too_large, 255), "255") << "the nearest integer there is";
  EXPECT_EQ(result(bit_or, -too_large, 0), "-9.22337e+18");
  EXPECT_EQ(result(bit_or, infinity, 0), "9.22337e+18");
  EXPECT_EQ(result(bit_or, kNan, 0), "0");
  EXPECT_EQ(complement(kNan), "-1");
  EXPECT_EQ(result(shift_left, 1, 64), "undef | shift too large");
  EXPECT_EQ(result(shift_right, 1, infinity), "undef | shift too large");
  EXPECT_EQ(result(shift_left, 1, -1), "undef | negative shift");
  EXPECT_EQ(result(shift_right, 1, -too_large), "undef | negative shift");
  EXPECT_EQ(result(bit_and, list({1, 2}), 3), "undef | undefined operation (vector & number)");
  EXPECT_EQ(result(bit_or, Value::boolean(true), 1), "undef | undefined operation (bool | number)");
  EXPECT_EQ(result(shift_left, text("a"), -1), "undef | undefined operation (string << number)");
  EXPECT_EQ(result(shift_right, 1, Value()), "undef | undefined operation (number >> undefined)");
  EXPECT_EQ(complement(list({1})), "undef | undefined operation (~vector)");
}

TEST(Operators, MultiplyVectorsAndMatrices) {
  const Value matrix = list({list({1, 2}), list({3, 4})});
  EXPECT_EQ(result(multiply, list({1, 2}), list({3, 4})), "11");
  EXPECT_EQ(result(multiply, matrix, list({1, 2})), "[5, 11]");
  EXPECT_EQ(result(multiply, list({1, 2}), matrix), "[7, 10]");
  EXPECT_EQ(result(multiply, matrix, matrix), "[[7, 10], [15, 22]]");
}

TEST(Operators, SayWhyVectorsCannotBeMultiplied) {
  const Value row = list({1, 2}), matrix = list({row, list({3, 4})}), a = text("a");
  const auto problem = [](const Value& left, const Value& right) {
    return result(multiply, left, right);
  };
  EXPECT_EQ(problem(list({}), row), "undef | Multiplication is undefined on empty vectors");
  EXPECT_EQ(problem(row, list({1})), "undef | vector*vector requires matching lengths (2 != 1)");
  EXPECT_EQ(problem(list({1, a}), row), "undef | undefined operation (string * number)");
  EXPECT_EQ(problem(row, list({row})),
            "undef | vector*matrix requires vector length to match matrix row count (2 != 1)");
  EXPECT_EQ(problem(row, list({row, list({3})})),
            "undef || Matrix must be rectangular. Problem at row 1"
            " | Matrix must be rectangular. Problem at row 1");
  EXPECT_EQ(problem(matrix, list({1})),
            "undef | matrix*vector requires matrix column count to match vector length (2 != 1)");
  EXPECT_EQ(problem(list({row, 3}), row), "undef | Matrix must be rectangular. Problem at row 1");
  EXPECT_EQ(problem(list({row, list({3, a})}), row),
            "undef | Matrix must contain only numbers. Problem at row 1, col 1");
  EXPECT_EQ(problem(matrix, list({1, a})),
            "undef | Vector must contain only numbers. Problem at index 1");
  EXPECT_EQ(problem(matrix, list({row})),
            "undef | matrix*matrix requires left operand column count to match right operand row "
            "count (2 != 1)");
  EXPECT_EQ(problem(list({row, 3}), matrix),
            "undef | matrix*matrix left operand row length does not match right operand row count "
            "(0 != 2) at row 1");
  EXPECT_EQ(problem(list({row, list({3, a})}), matrix),
            "undef || Vector must contain only numbers. Problem at index 1"
            " | Vector must contain only numbers. Problem at index 1"
            "\n\twhile processing left operand at row 1");
  EXPECT_EQ(problem(list({a}), row),
            "undef | undefined vector*vector multiplication where first elements are types string "
            "and number");
}

TEST(Operators, Compare) {
  EXPECT_EQ(result(less, text("B"), text("a")), "true");
  EXPECT_EQ(result(greater, text("é"), text("z")), "true");
  EXPECT_EQ(result(less, Value::boolean(false), Value::boolean(true)), "true");
  EXPECT_EQ(result(less, list({1, 2}), list({1, 2, text("a")})), "true");
  EXPECT_EQ(result(less, list({kNan, 1}), list({kNan, 2})), "true");
  EXPECT_EQ(result(less_equal, list({kNan}), list({kNan})), "true");
  EXPECT_EQ(result(greater_equal, list({kNan}), list({1})), "true");
  EXPECT_EQ(result(less, make_range(1, 1, 0), make_range(0, 1, 2)), "true");
}

TEST(Operators, SayWhatCannotBeCompared) {
  EXPECT_EQ(result(greater_equal, 1, text("a")), "undef | undefined operation (number >= string)");
  EXPECT_EQ(result(less_equal, Value(), Value()),
            "undef | operation undefined (undefined <= undefined)");
  EXPECT_EQ(result(greater, list({1, list({2, Value()})}), list({1, list({2, 3})})),
            "undef | undefined operation (number < undefined)"
            "\n\tin vector comparison at index 1\n\tin vector comparison at index 1");
}

TEST(Operators, KnowWhatIsEqual) {
  EXPECT_TRUE(equal(Value(), Value()));
  EXPECT_FALSE(equal(kNan, kNan));
  EXPECT_TRUE(equal(0.0, -0.0));
  EXPECT_FALSE(equal(1, Value::boolean(true)));
  EXPECT_TRUE(equal(make_range(0, 1, 2), make_range(0, 1, 2.5)));
  EXPECT_TRUE(equal(make_range(0, 1, -2), make_range(5, 1, 3)));
  EXPECT_FALSE(equal(list({1, 2}), list({1})));
}

TEST(Operators, Index) {
  const auto at = [](const Value& container, const Value& index) {
    return echo_text(element_at(container, index));
  };
  const Value vector = list({1, 2, 3});
  EXPECT_EQ(at(vector, 1.9), "2");
  EXPECT_EQ(at(vector, -0.5), "1");
  EXPECT_EQ(at(vector, -1), "undef");
  EXPECT_EQ(at(vector, 3), "undef");
  EXPECT_EQ(at(vector, 4294967297.0), "undef");
  EXPECT_EQ(at(vector, kNan), "undef");
  EXPECT_EQ(at(text("aé€x"), 2), "\"€\"");
  EXPECT_EQ(at(text("a\xe2\x82"), 1), "undef");
  EXPECT_EQ(at(make_range(1, 2, 5), 1), "2");
  EXPECT_EQ(at(5, 0), "undef");
  const Dialect& dialect = dialect_of(LanguageVersion::k2021);
  EXPECT_EQ(echo_text(member(vector, "z", dialect)), "3");
  EXPECT_EQ(echo_text(member(vector, "w", dialect)), "undef");
  EXPECT_EQ(echo_text(member(make_range(1, 2, 5), "end", dialect)), "5");
}

TEST(ValueText, IsThatOfEchoAndStr) {
  const Value value =
      list({1.5, text("a\"b"), list({}), list({list({2}), Value()}), make_range(0, 1, 2)});
  EXPECT_EQ(echo_text(value), "[1.5, \"a\"b\", [], [[2], undef], [0 : 1 : 2]]");
  std::string shown;
  append_str_text(shown, text("a"));
  append_str_text(shown, list({text("b")}));
  EXPECT_EQ(shown, "a[\"b\"]");
}

}  // namespace
}  // namespace language
