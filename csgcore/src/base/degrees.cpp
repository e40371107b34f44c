#include "base/degrees.hpp"

#include <cmath>
#include <numbers>

namespace csgcore {
namespace {

constexpr double kSqrt1_2 = 0.70710678118654752440;
constexpr double kSqrt3_4 = 0.86602540378443864676;

double radians(double angle_deg) { return angle_deg * (std::numbers::pi / 180); }

// These take angles from 0 to 90°, both included.
double sin_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return 0.5;
  if (angle_deg == 45) return kSqrt1_2;
  if (angle_deg == 60) return kSqrt3_4;
  return angle_deg < 45 ? std::sin(radians(angle_deg)) : std::cos(radians(90 - angle_deg));
}

double cos_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return kSqrt3_4;
  if (angle_deg == 45) return kSqrt1_2;
  if (angle_deg == 60) return 0.5;
  return angle_deg > 45 ? std::sin(radians(90 - angle_deg)) : std::cos(radians(angle_deg));
}

}  // namespace

double sin_degrees(double angle_deg) {
  if (angle_deg >= 180) return -sin_degrees(angle_deg - 180);
  return sin_first_quadrant(angle_deg > 90 ? 180 - angle_deg : angle_deg);
}

double cos_degrees(double angle_deg) {
  if (angle_deg >= 180) return -cos_degrees(angle_deg - 180);
  return angle_deg > 90 ? -cos_first_quadrant(180 - angle_deg) : cos_first_quadrant(angle_deg);
}

}  // namespace csgcore
