#pragma once

namespace csgcore {

/// The slack of every test that claims certainty, in canonical units, which are those of the
/// primitive's size. It is far above the rounding in the tests themselves (some 20 operations of
/// 2^-53), and far below any size that matters. The rounding of the map into canonical space is
/// bounded separately, per primitive and cell.
constexpr double kCanonicalSlack = 1e-12;

}  // namespace csgcore
