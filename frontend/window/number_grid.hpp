// The values that a number of the customizer takes while it is dragged.
#pragma once

#include <optional>

#include "language/customizer_parameter.hpp"

namespace window {

class NumberGrid {
 public:
  /// Of one of a parameter's numbers, whose default this is. Without a step in its comment it is 1
  /// where all are integers, or else a power of ten that divides its range into some hundreds.
  NumberGrid(const language::CustomizerParameter& parameter, double fallback);

  double step() const { return step_; }
  const std::optional<language::ParameterRange>& range() const { return range_; }
  /// Returns the next value of the grid, within the range.
  double snap(double value) const;
  /// Returns a value within the range.
  double clamp(double value) const;

 private:
  double origin_;
  double step_;
  int decimals_;  // of origin and step
  std::optional<language::ParameterRange> range_;
};

}  // namespace window
