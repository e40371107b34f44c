// Angles in radians.
#pragma once

#include <numbers>

namespace frontend {

inline constexpr double kTurn = 2 * std::numbers::pi;
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace frontend
