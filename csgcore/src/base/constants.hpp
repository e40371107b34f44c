// Numbers that several rooms compute with.
#pragma once

#include <limits>

namespace csgcore {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The distance from 1 to the next double.
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// As a share of the thickness tolerance: a primitive counts as lying in a surface if it reaches
/// out of it by no more than this, a thousand times the rounding.
constexpr double kCoplanar = 0x1p-10;

}  // namespace csgcore
