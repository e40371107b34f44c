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

/// The slack of every test that claims certainty, in canonical units, which are those of the
/// primitive's size. It is far above the rounding in the tests themselves (some 20 operations of
/// 2^-53), and far below any size that matters. The rounding of the map into canonical space is
/// bounded separately, per primitive and cell.
constexpr double kCanonicalSlack = 1e-12;

}  // namespace csgcore
