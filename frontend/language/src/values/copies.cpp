#include "values/copies.hpp"

#include <bit>
#include <utility>
#include <vector>

#include "language/make.hpp"
#include "values/range.hpp"

namespace language {
namespace {

constexpr int kMostDepth = 1000;  // of vectors: recursion takes some hundred bytes for each
constexpr size_t kMostCompared = 100'000;  // elements: what is shared many times has no end

bool are_same_bits(double left, double right) {
  return std::bit_cast<uint64_t>(left) == std::bit_cast<uint64_t>(right);
}

bool are_same_ranges(const RangeObject& left, const RangeObject& right) {
  return are_same_bits(left.begin, right.begin) && are_same_bits(left.step, right.step) &&
         are_same_bits(left.end, right.end);
}

}  // namespace

Value ValueCopier::copy(const Value& value, int depth) {
  if (value.type() < ValueType::kString) return value;
  if (value.is_function() || depth > kMostDepth) return Value::unset();
  const auto known = copies_.find(value.object());
  if (known != copies_.end()) return known->second;
  Value made = copy_object(value, depth);
  copies_.emplace(value.object(), made);
  return made;
}

Value ValueCopier::copy_object(const Value& value, int depth) {
  const size_t size = value.is_string()   ? value.text().size()
                      : value.is_vector() ? value.elements().size()
                                          : 1;
  if (size > elements_left_) return Value::unset();
  elements_left_ -= size;
  if (value.is_string()) return make_string(value.text());
  if (value.is_range()) {
    const RangeObject& range = value.range();
    return make_range(range.begin, range.step, range.end);
  }
  Value vector = make_vector(value.elements().size());
  for (const Value& element : value.elements()) {
    Value made = copy(element, depth + 1);
    if (!made.is_set()) return Value::unset();
    append_element(vector, std::move(made));
  }
  return vector;
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
    if (a->is_function() || compared > kMostCompared) return false;
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
