// Ranges: [begin : step : end].
#pragma once

#include <cstdint>

#include "language/value.hpp"

namespace language {

struct RangeObject : SharedObject {
  double begin, step, end;
  /// Of 2^32 and more values it counts as many as it can; else they are folded.
  bool has_nearest_count;

  /// Returns how many values it has, by OpenSCAD's rules (LANGUAGE.md, "Values"). A step of zero
  /// counts without yielding anything: see steps().
  uint32_t count() const;
  /// Returns how many values a loop over it sees.
  uint32_t steps() const { return step == 0 ? 0 : count(); }
  /// Returns a value, of those below steps(). The first one is `begin` also where the step is
  /// infinite, or the sum would lose the sign of zero.
  double value(uint32_t number) const { return number == 0 ? begin : begin + step * number; }
};

Value make_range(double begin, double step, double end, bool has_nearest_count = false);

/// What is said of a range that is written [begin : end].
struct RangeProblem {
  bool is_reversed = false;  // begin and end were swapped, which is deprecated
};
/// Returns the range of [begin : end], or of [begin : step : end] if `step` is given. Undef unless
/// all are numbers.
Value range_of(const Value& begin, const Value& end, RangeProblem& problem);
Value range_of(const Value& begin, const Value& step, const Value& end,
               bool has_nearest_count = false);

inline const RangeObject& Value::range() const {
  return static_cast<const RangeObject&>(*payload_.object);
}

}  // namespace language
