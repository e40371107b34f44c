#pragma once

namespace csgcore {

/// Relative slack of every test that claims certainty in canonical space. There a primitive has size
/// 1, so that the rounding of a cell's transformed corners is a few times 2^-53 times the cell's
/// distance in primitive sizes; the slack covers cells up to 1,000 primitive sizes away, and where
/// the distance is larger than that the claims are not close.
constexpr double kCanonicalSlack = 1e-12;

}  // namespace csgcore
