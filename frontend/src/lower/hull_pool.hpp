// The convex solids of a design. Those that differ in their place only share their polyhedra.
#pragma once

#include <map>
#include <vector>

#include "hulls/convex_solid.hpp"

namespace frontend {

class HullPool {
 public:
  /// Returns what convex_solid() does. The coordinates are finite.
  ConvexSolid solid(const Generators& generators);

 private:
  std::map<std::vector<double>, ConvexSolid> solids_;  // by generators, the first one at the origin
};

}  // namespace frontend
