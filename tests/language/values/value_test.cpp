#include "language/value.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "language/make.hpp"
#include "values/function_object.hpp"
#include "values/object_memory.hpp"
#include "values/operators.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

using namespace operators;

constexpr int kDeep = 1'000'000;
constexpr int kQuiteDeep = 100'000;

Value nested(size_t levels, Value innermost = 1.0) {
  Value value = std::move(innermost);
  for (size_t i = 0; i < levels; ++i) {
    Value outer = make_vector(1);
    append_element(outer, std::move(value));
    value = std::move(outer);
  }
  return value;
}

TEST(Value, KnowsItsTruth) {
  for (const Value& value :
       {Value(), Value(0.0), Value(-0.0), Value::boolean(false), make_string(""), make_vector()})
    EXPECT_FALSE(value.is_true()) << echo_text(value);
  for (const Value& value : {Value(0.0 / 0.0), Value(2.0), Value::boolean(true), make_string("0"),
                             nested(1), make_range(0, 1, -1)})
    EXPECT_TRUE(value.is_true()) << echo_text(value);
}

TEST(Value, KnowsWhetherAVectorHoldsNumbers) {
  EXPECT_TRUE(make_vector().holds_numbers());
  const Value numbers[] = {1.0, 2.0}, mixed[] = {1.0, make_string("2")};
  EXPECT_TRUE(make_vector(numbers).holds_numbers());
  EXPECT_FALSE(make_vector(mixed).holds_numbers());
  Value vector = make_vector(numbers);
  append_elements(vector, numbers);
  EXPECT_TRUE(vector.holds_numbers());
  const Value before = vector;
  append_element(vector, Value::boolean(true));  // to a copy, since there are two references
  EXPECT_TRUE(before.holds_numbers());
  EXPECT_FALSE(vector.holds_numbers());
  append_elements(vector, numbers);  // in another block
  EXPECT_FALSE(vector.holds_numbers());
  Value copy = vector;
  append_element(copy, 1.0);
  EXPECT_FALSE(copy.holds_numbers());
  Value other = make_vector(2);
  append_in_room(other, 1.0);
  EXPECT_TRUE(other.holds_numbers());
  append_elements(other, mixed);
  EXPECT_FALSE(other.holds_numbers());
}

TEST(Value, FreesWhatItHolds) {
  const int64_t before = object_memory.used;
  {
    Value vector = make_vector();
    for (int i = 0; i < 100; ++i) append_element(vector, make_string("text"));
    append_element(vector, vector);
    append_element(vector, make_range(0, 1, 2));
    const Value copy = vector;
    EXPECT_GT(object_memory.used, before);
  }
  EXPECT_EQ(object_memory.used, before);
}

TEST(Value, IsDestroyedWithoutRecursion) {
  const int64_t before = object_memory.used;
  { const Value value = nested(kDeep); }
  {
    Value value = make_vector();
    for (int i = 0; i < kQuiteDeep; ++i) {  // nests in the second element
      Value outer = make_vector(2);
      append_element(outer, make_string("a"));
      append_element(outer, std::move(value));
      value = std::move(outer);
    }
  }
  EXPECT_EQ(object_memory.used, before);
}

// A function that holds a value, as a closure does.
struct HoldingFunction : FunctionObject {
  explicit HoldingFunction(Value held) : value(std::move(held)) {}
  void append_text(std::string& out) const override { out += "function() 1"; }
  Value value;
};

TEST(Value, CountsFunctions) {
  const int64_t before = object_memory.used;
  {
    const Value value = Value::adopt(new HoldingFunction({}));
    EXPECT_EQ(object_memory.used - before, int64_t{sizeof(HoldingFunction)});
  }
  EXPECT_EQ(object_memory.used, before);
}

TEST(Value, DestroysChainsOfFunctions) {
  Value value;
  for (int i = 0; i < kQuiteDeep; ++i) value = Value::adopt(new HoldingFunction(nested(1, value)));
  EXPECT_EQ(echo_text(value), "function() 1");
}

TEST(Value, AppendsInPlaceOnlyWhereItIsNotShared) {
  Value vector = make_vector(4);
  const SharedObject* object = vector.object();
  append_element(vector, 1.0);
  EXPECT_EQ(vector.object(), object);
  const Value copy = vector;
  append_element(vector, 2.0);
  EXPECT_EQ(echo_text(vector), "[1, 2]");
  EXPECT_EQ(echo_text(copy), "[1]");
  append_elements(vector, vector.elements());
  EXPECT_EQ(echo_text(vector), "[1, 2, 1, 2]");
}

TEST(Value, DoesNotTakeMoreMemoryThanAllowed) {
  const ObjectMemory before = object_memory;
  object_memory.limit = object_memory.used + 1000;
  EXPECT_THROW(make_vector(1000), OutOfValueMemory);
  EXPECT_THROW(make_string(std::string(2000, 'a')), OutOfValueMemory);
  EXPECT_NO_THROW(make_vector(10));
  object_memory = before;
}

TEST(Value, NestedDeeplyIsComparedAndComputedWithoutRecursion) {
  const Value value = nested(kQuiteDeep), other = nested(kQuiteDeep, 2.0);
  OperatorProblem problem;
  EXPECT_TRUE(equal(value, value));
  EXPECT_FALSE(equal(value, other));
  EXPECT_TRUE(less(value, other, problem).is_true());
  std::string text;
  append_value_text(text, value);
  EXPECT_EQ(text.size(), size_t{2 * kQuiteDeep + 1});
  EXPECT_EQ(problem.text, "");
}

// A recursion can nest vectors without end, at a cost that grows with each call.
TEST(Value, NestsOnlySoDeeplyWhereItIsComputedOrShown) {
  const Value value = nested(kMostNesting), other = nested(kMostNesting, 2.0);
  OperatorProblem problem;
  EXPECT_TRUE(equal(add(value, value, problem), other));
  EXPECT_TRUE(equal(multiply(2.0, value, problem), other));
  EXPECT_TRUE(equal(negate(negate(value, problem), problem), value));
  EXPECT_EQ(echo_text(value).size(), 2 * kMostNesting + 1);
  const Value deeper = nested(kMostNesting + 1);
  EXPECT_THROW(add(deeper, deeper, problem), TooLarge);
  EXPECT_THROW(multiply(2.0, deeper, problem), TooLarge);
  EXPECT_THROW(echo_text(deeper), TooLarge);
}

TEST(Range, CountsAsOpenScadDoes) {
  const auto count = [](double begin, double step, double end) {
    return make_range(begin, step, end).range().count();
  };
  constexpr uint32_t kMost = 4294967295u;
  EXPECT_EQ(count(0, 1, 5), 6u);
  EXPECT_EQ(count(0, 0.1, 1), 11u);
  EXPECT_EQ(count(0, 1, -1), 0u);
  EXPECT_EQ(count(0, -1, 1), 0u);
  EXPECT_EQ(count(3, 0, 3), 1u);
  EXPECT_EQ(count(0, 0, 1), kMost);
  EXPECT_EQ(count(0, 1, 1.0 / 0.0), kMost);
  EXPECT_EQ(count(0, 1.0 / 0.0, 5), 1u);
  EXPECT_EQ(count(0, 1, 0.0 / 0.0), 0u);
  EXPECT_EQ(count(0, 1, 4294967297.0), 1u);
  EXPECT_EQ(count(0, 1, 1e10), 1410065408u);
  EXPECT_EQ(count(6, 7, 1e30), 1u);
  EXPECT_EQ(make_range(3, 0, 3).range().steps(), 0u);
  EXPECT_EQ(make_range(5, 1.0 / 0.0, 9).range().value(0), 5);
}

}  // namespace
}  // namespace language
