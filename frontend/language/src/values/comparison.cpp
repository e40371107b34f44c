// How values compare (LANGUAGE.md, "Values"): without recursion, however deeply vectors nest.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "values/members_object.hpp"
#include "values/operators.hpp"
#include "values/range.hpp"
#include "values/tree_map.hpp"

namespace language {
namespace {

enum class Ordering : uint8_t {
  kLess,
  kGreater,
  kNeither,    // equal, or not comparable numbers (NaN)
  kUndefined,  // OpenSCAD refuses to compare them; the problem says why
};

template <typename T>
Ordering ordering_of(const T& left, const T& right) {
  if (left < right) return Ordering::kLess;
  return right < left ? Ordering::kGreater : Ordering::kNeither;
}

Ordering order_ranges(const RangeObject& left, const RangeObject& right) {
  const uint32_t left_count = left.count(), right_count = right.count();
  if (left_count == 0 || right_count == 0) return ordering_of(left_count > 0, right_count > 0);
  if (left.begin != right.begin) return ordering_of(left.begin, right.begin);
  if (left.step != right.step) return ordering_of(left.step, right.step);
  return ordering_of(left_count, right_count);
}

// Compares values that are not both vectors.
Ordering order_leaves(const Value& left, std::string_view sign, const Value& right,
                      OperatorProblem& problem) {
  if (left.type() != right.type()) {
    problem.text = undefined_operation(left, sign, right);
    return Ordering::kUndefined;
  }
  switch (left.type()) {
    case ValueType::kNumber:
      return ordering_of(left.number(), right.number());
    case ValueType::kBool:
      return ordering_of(left.boolean(), right.boolean());
    case ValueType::kString:
      return ordering_of(left.text(), right.text());
    case ValueType::kRange:
      return order_ranges(left.range(), right.range());
    default:
      problem.text = operation_undefined(left, sign, right);
      return Ordering::kUndefined;
  }
}

bool are_leaves_equal(const Value& left, const Value& right) {
  if (left.type() != right.type()) return false;
  switch (left.type()) {
    case ValueType::kNumber:
      return left.number() == right.number();
    case ValueType::kBool:
      return left.boolean() == right.boolean();
    case ValueType::kString:
      return left.text() == right.text();
    case ValueType::kRange:
      return order_ranges(left.range(), right.range()) == Ordering::kNeither;
    case ValueType::kFunction:
      return left.object() == right.object();
    default:
      return true;
  }
}

// Returns what a value consists of that has parts.
std::span<const Value> parts_of(const Value& value) {
  return value.is_vector() ? value.elements() : value.members().keys_and_values();
}

bool have_parts(const Value& left, const Value& right) {
  return (left.is_vector() && right.is_vector()) || (left.is_object() && right.is_object());
}

// Two vectors, or objects, that are being compared; all elements below `next` are equal, or neither
// is less.
struct Pair {
  std::span<const Value> left, right;
  size_t next = 0;

  Pair(const Value& left_vector, const Value& right_vector)
      : left(parts_of(left_vector)), right(parts_of(right_vector)) {}
  bool has_both() const { return next < left.size() && next < right.size(); }
};

// Adds the lines that say where within vectors the comparison failed, from inside out. Each pair's
// `next` is already past the element that failed.
void append_indices(const LevelStack<Pair>& pairs, std::string& text) {
  for (auto pair = pairs.levels().rbegin(); pair != pairs.levels().rend(); ++pair)
    text += "\n\tin vector comparison at index " + std::to_string(pair->next - 1);
}

// Compares two values for an operator that `sign` spells; elements of vectors are compared by "<".
Ordering order(const Value& left, std::string_view sign, const Value& right,
               OperatorProblem& problem) {
  if (!left.is_vector() || !right.is_vector()) return order_leaves(left, sign, right, problem);
  LevelStack<Pair> pairs;
  pairs.push(left, right);
  while (true) {
    Ordering ordering = Ordering::kNeither;
    count_work();
    Pair& pair = pairs.top();
    if (pair.has_both()) {
      const Value &a = pair.left[pair.next], &b = pair.right[pair.next];
      ++pair.next;
      if (a.is_vector() && b.is_vector()) {
        pairs.push(a, b);
        continue;
      }
      ordering = order_leaves(a, "<", b, problem);
      if (ordering == Ordering::kUndefined) append_indices(pairs, problem.text);
      if (ordering != Ordering::kNeither) return ordering;
    } else {
      ordering = ordering_of(pair.left.size(), pair.right.size());
      pairs.pop();
      if (ordering != Ordering::kNeither || pairs.empty()) return ordering;
    }
  }
}

Value compared(Ordering ordering, bool is_less, bool is_neither, bool is_greater) {
  if (ordering == Ordering::kUndefined) return Value::undef();
  return Value::boolean(ordering == Ordering::kLess      ? is_less
                        : ordering == Ordering::kGreater ? is_greater
                                                         : is_neither);
}

constexpr size_t kMostCompared = 100'000;  // elements: what is shared many times has no end

bool are_same_bits(double left, double right) {
  return std::bit_cast<uint64_t>(left) == std::bit_cast<uint64_t>(right);
}

bool are_same_ranges(const RangeObject& left, const RangeObject& right) {
  return are_same_bits(left.begin, right.begin) && are_same_bits(left.step, right.step) &&
         are_same_bits(left.end, right.end);
}

}  // namespace

namespace operators {

Value less(const Value& left, const Value& right, OperatorProblem& problem) {
  return compared(order(left, "<", right, problem), true, false, false);
}

Value less_equal(const Value& left, const Value& right, OperatorProblem& problem) {
  if (left.is_vector() && right.is_vector())  // "not greater", which differs with NaN
    return compared(order(right, "<", left, problem), false, true, true);
  return compared(order(left, "<=", right, problem), true, true, false);
}

Value greater(const Value& left, const Value& right, OperatorProblem& problem) {
  if (left.is_vector() && right.is_vector())
    return compared(order(right, "<", left, problem), true, false, false);
  return compared(order(left, ">", right, problem), false, false, true);
}

Value greater_equal(const Value& left, const Value& right, OperatorProblem& problem) {
  if (left.is_vector() && right.is_vector())
    return compared(order(left, "<", right, problem), false, true, true);
  return compared(order(left, ">=", right, problem), false, true, true);
}

}  // namespace operators

bool are_equal(const Value& left, const Value& right) {
  if (!have_parts(left, right)) return are_leaves_equal(left, right);
  LevelStack<Pair> pairs;
  pairs.push(left, right);
  while (!pairs.empty()) {
    count_work();
    Pair& pair = pairs.top();
    if (pair.left.size() != pair.right.size()) return false;
    if (!pair.has_both()) {
      pairs.pop();
      continue;
    }
    const Value &a = pair.left[pair.next], &b = pair.right[pair.next];
    ++pair.next;
    if (have_parts(a, b))
      pairs.push(a, b);
    else if (!are_leaves_equal(a, b))
      return false;
  }
  return true;
}

bool are_identical(const Value& left, const Value& right) {
  std::vector<std::pair<const Value*, const Value*>> pending = {{&left, &right}};
  for (size_t compared = 0; !pending.empty(); ++compared) {
    const auto [a, b] = pending.back();
    pending.pop_back();
    if (a->type() != b->type()) return false;
    switch (a->type()) {
      case ValueType::kUnset:
      case ValueType::kUndef:
        continue;
      case ValueType::kBool:
        if (a->boolean() != b->boolean()) return false;
        continue;
      case ValueType::kNumber:
        if (!are_same_bits(a->number(), b->number())) return false;
        continue;
      default:
        break;
    }
    if (a->object() == b->object()) continue;
    if (a->type() >= ValueType::kFunction || compared > kMostCompared) return false;
    if (a->is_string() && a->text() != b->text()) return false;
    if (a->is_range() && !are_same_ranges(a->range(), b->range())) return false;
    if (!a->is_vector()) continue;
    if (a->elements().size() != b->elements().size()) return false;
    for (size_t i = 0; i < a->elements().size(); ++i)
      pending.emplace_back(&a->elements()[i], &b->elements()[i]);
  }
  return true;
}

}  // namespace language
