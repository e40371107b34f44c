#pragma once

namespace csgcore {

/// Relative slack of every test that claims certainty, in units of the primitive's size: far above
/// what is rounded in the tests themselves (some 20 operations of 2^-53), far below what matters.
/// What is rounded on the way into canonical space is counted besides, per primitive and cell.
constexpr double kCanonicalSlack = 1e-12;

}  // namespace csgcore
