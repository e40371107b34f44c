#include "values/range.hpp"

#include <cmath>
#include <limits>
#include <new>

#include "base/number_text.hpp"
#include "values/object_memory.hpp"

namespace language {

uint32_t RangeObject::count() const {
  constexpr uint32_t kMost = std::numeric_limits<uint32_t>::max();
  if (std::isnan(begin) || std::isnan(step) || std::isnan(end)) return 0;
  if (step < 0 ? begin < end : begin > end) return 0;
  if (begin == end || std::isinf(step)) return 1;
  if (std::isinf(begin) || std::isinf(end) || step == 0) return kMost;
  // A quotient that rounding has put just below an integer counts as that integer.
  const double steps = std::nextafter((end - begin) / step, double{kMost});
  const uint32_t whole = has_nearest_count ? nearest_count(steps) : low_bits(steps);
  return whole == kMost ? kMost : whole + 1;
}

Value make_range(double begin, double step, double end, bool has_nearest_count) {
  auto* range = new (allocate_object(sizeof(RangeObject))) RangeObject;
  range->type = ValueType::kRange;
  range->begin = begin;
  range->step = step;
  range->end = end;
  range->has_nearest_count = has_nearest_count;
  return Value::adopt(range);
}

Value range_of(const Value& begin, const Value& end, RangeProblem& problem) {
  if (!begin.is_number() || !end.is_number()) return Value::undef();
  problem.is_reversed = end.number() < begin.number();
  if (problem.is_reversed) return make_range(end.number(), 1, begin.number());
  return make_range(begin.number(), 1, end.number());
}

Value range_of(const Value& begin, const Value& step, const Value& end, bool has_nearest_count) {
  if (!begin.is_number() || !step.is_number() || !end.is_number()) return Value::undef();
  return make_range(begin.number(), step.number(), end.number(), has_nearest_count);
}

}  // namespace language
