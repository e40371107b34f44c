#include "language/degrees.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace language {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kRootOfHalf = 0.70710678118654752440;
constexpr double kRootOfThreeQuarters = 0.86602540378443864676;
constexpr double kRootOfThird = 0.57735026918962576451;
constexpr double kRootOfThree = 1.73205080756887729353;

// Beyond so many periods a double has no fraction of a period left.
constexpr double kMostPeriods = 4503599627370496.0;  // 2^52

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }
double degrees(double radians) { return radians * (180 / std::numbers::pi); }

// Returns the sine of an angle in [0, 90].
double acute_sine(double angle) {
  if (angle == 30) return 0.5;
  if (angle == 45) return kRootOfHalf;
  if (angle == 60) return kRootOfThreeQuarters;
  return angle < 45 ? std::sin(radians(angle)) : std::cos(radians(90 - angle));
}

double acute_cosine(double angle) {
  if (angle == 30) return kRootOfThreeQuarters;
  if (angle == 45) return kRootOfHalf;
  if (angle == 60) return 0.5;
  return angle > 45 ? std::sin(radians(90 - angle)) : std::cos(radians(angle));
}

double acute_tangent(double angle) {
  if (angle == 30) return kRootOfThird;
  if (angle == 45) return 1;
  if (angle == 60) return kRootOfThree;
  return std::tan(radians(angle));
}

// Brings an angle into [0, 360), or to NaN.
double reduced(double angle) {
  if (angle >= 0 && angle < 360) return angle;
  if (!(std::abs(angle) < kMostPeriods * 360)) return kNotANumber;
  return angle - 360 * std::floor(angle / 360);
}

}  // namespace

double sine_of_degrees(double angle) {
  angle = reduced(angle);
  if (std::isnan(angle)) return angle;
  const bool is_negative = angle >= 180;
  if (is_negative) angle -= 180;
  if (angle > 90) angle = 180 - angle;
  const double sine = acute_sine(angle);
  return is_negative ? -sine : sine;
}

double cosine_of_degrees(double angle) {
  angle = reduced(angle);
  if (std::isnan(angle)) return angle;
  bool is_negative = angle >= 180;
  if (is_negative) angle -= 180;
  if (angle > 90) {
    angle = 180 - angle;
    is_negative = !is_negative;
  }
  const double cosine = acute_cosine(angle);
  return is_negative ? -cosine : cosine;
}

double tangent_of_degrees(double angle, bool has_nearest_integers) {
  if (!(std::abs(angle) < kMostPeriods * 360)) return kNotANumber;
  // OpenSCAD counts the half turns in 32 bits.
  constexpr double kLeast = -2147483648.0, kMost = 2147483647.0;
  double half_turns = std::floor(angle / 180);
  if (half_turns > kMost) half_turns = has_nearest_integers ? kMost : kLeast;
  half_turns = std::max(half_turns, kLeast);
  angle -= 180 * half_turns;
  const bool is_odd = std::fmod(half_turns, 2) != 0;
  if (angle == 0) return is_odd ? -0.0 : 0.0;
  if (angle == 90)
    return is_odd ? -std::numeric_limits<double>::infinity()
                  : std::numeric_limits<double>::infinity();
  return angle > 90 ? -acute_tangent(180 - angle) : acute_tangent(angle);
}

double arc_sine_degrees(double sine) {
  const double angle = degrees(std::asin(sine));
  const double rounded = std::round(angle);
  return sine_of_degrees(rounded) == sine ? rounded : angle;
}

double arc_cosine_degrees(double cosine) {
  const double angle = degrees(std::acos(cosine));
  const double rounded = std::round(angle);
  return cosine_of_degrees(rounded) == cosine ? rounded : angle;
}

double arc_tangent_degrees(double tangent) {
  const double angle = degrees(std::atan(tangent));
  const double rounded = std::round(angle);
  return tangent_of_degrees(rounded) == tangent ? rounded : angle;
}

double arc_tangent_degrees(double y, double x) {
  constexpr double kRoundedWithin = 3.0e-14;  // OpenSCAD's choice
  const double angle = degrees(std::atan2(y, x));
  const double rounded = std::round(angle);
  return std::abs(angle - rounded) < kRoundedWithin ? rounded : angle;
}

}  // namespace language
