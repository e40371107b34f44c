#include "number_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace window {
namespace {

constexpr int kMostDecimals = 9;

/// Returns how many decimals a number is written with.
int decimals_of(double number) {
  for (int decimals = 0; decimals < kMostDecimals; ++decimals) {
    const double scaled = number * std::pow(10, decimals);
    if (std::abs(scaled - std::round(scaled)) <= 1e-9 * std::max(1.0, std::abs(scaled))) {
      return decimals;
    }
  }
  return kMostDecimals;
}

bool is_integer(double number) { return number == std::round(number); }

/// Returns the power of ten that is a hundredth to a thousandth of a length.
double fine_step(double length) {
  return std::pow(10, std::clamp(std::floor(std::log10(length)) - 2, -6.0, 6.0));
}

double natural_step(const std::optional<language::ParameterRange>& range, double fallback) {
  if (!range) return is_integer(fallback) ? 1 : fine_step(std::abs(fallback));
  const bool are_integers =
      is_integer(range->min) && is_integer(range->max) && is_integer(fallback);
  return are_integers ? 1 : fine_step(range->max - range->min);
}

}  // namespace

NumberGrid::NumberGrid(const language::CustomizerParameter& parameter, double fallback)
    : range_(parameter.range) {
  const std::optional<double> step = range_ ? range_->step : parameter.step;
  step_ = step.value_or(natural_step(range_, fallback));
  origin_ = range_ ? range_->min : step ? fallback : 0;
  decimals_ = std::max(decimals_of(step_), decimals_of(origin_));
}

double NumberGrid::clamp(double value) const {
  return range_ ? std::clamp(value, range_->min, range_->max) : value;
}

/// The result is written with few digits: 0.3 rather than 3 · 0.1.
double NumberGrid::snap(double value) const {
  const double near = origin_ + std::round((value - origin_) / step_) * step_;
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals_, near);
  return clamp(std::strtod(text, nullptr));
}

}  // namespace window
