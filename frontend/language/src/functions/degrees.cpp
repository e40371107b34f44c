#include "functions/degrees.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace language {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSqrtHalf = 0.70710678118654752440;
constexpr double kSqrtThreeQuarters = 0.86602540378443864676;

/// Returns the angle in [0, 360), or nan.
double within_turn(double angle_deg) {
  if (angle_deg >= 0 && angle_deg < 360) return angle_deg;
  constexpr double kMost = 0x1p52 * 360;
  if (!(std::abs(angle_deg) < kMost)) return std::numeric_limits<double>::quiet_NaN();
  return angle_deg - 360 * std::floor(angle_deg / 360);
}

}  // namespace

double sine_of_degrees(double angle_deg) {
  double angle = within_turn(angle_deg);
  const bool is_negative = angle >= 180;
  if (is_negative) angle -= 180;
  if (angle > 90) angle = 180 - angle;
  double sine = angle < 45 ? std::sin(angle * kDegree) : std::cos((90 - angle) * kDegree);
  if (angle == 30) sine = 0.5;
  if (angle == 45) sine = kSqrtHalf;
  if (angle == 60) sine = kSqrtThreeQuarters;
  return is_negative ? -sine : sine;
}

double cosine_of_degrees(double angle_deg) {
  double angle = within_turn(angle_deg);
  bool is_negative = angle >= 180;
  if (is_negative) angle -= 180;
  if (angle > 90) {
    angle = 180 - angle;
    is_negative = !is_negative;
  }
  double cosine = angle > 45 ? std::sin((90 - angle) * kDegree) : std::cos(angle * kDegree);
  if (angle == 60) cosine = 0.5;
  if (angle == 45) cosine = kSqrtHalf;
  if (angle == 30) cosine = kSqrtThreeQuarters;
  return is_negative ? -cosine : cosine;
}

}  // namespace language
