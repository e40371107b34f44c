// The crossings of a ray's path with the curves of a revolved profile (revolution_path.hpp). These
// are the roots of a quartic in the curve's parameter. They are isolated by halving its range, and
// found by Newton's method between bounds (NUMERICS.md, "Profiles").
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "primitives/crossings.hpp"
#include "primitives/revolution_path.hpp"

namespace csgcore {

/// The passage of a path by a piece, whose crossings it takes.
struct PiecePassage {
  const RevolutionPath& path;
  uint32_t face;  // the piece's number
  std::vector<Crossing>& found;

  /// `change`: 1 if the piece leads into the path at τ, −1 if it leads out of it.
  void add(double tau, int change) const {
    const double within_solid = std::clamp(tau, path.first, path.last);
    found.push_back({path.base + path.unit * within_solid, face, change * path.upwards()});
  }
};

/// A curve as a path sees it, and whether its ends lie within the path.
struct PathCurve {
  PathPoint start, control, end;
  double weight;
  bool from_within, to_within;
};

/// Adds the crossings of the path with the curve.
void cross_curve(const PiecePassage& passage, const PathCurve& curve);

}  // namespace csgcore
