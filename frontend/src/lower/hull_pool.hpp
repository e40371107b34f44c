// The convex solids of a design. Those that differ in their place only share their polyhedra.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "hulls/convex_solid.hpp"

namespace frontend {

class HullPool {
 public:
  /// Returns what convex_solid() does. The coordinates are finite. Any threads may call it.
  ConvexSolid solid(const Generators& generators);

 private:
  using Key = std::vector<double>;  // the generators, the first one at the origin

  ConvexSolid shared(const Generators& generators);

  std::mutex mutex_;       // of all below
  std::set<size_t> seen_;  // hashes of keys: a solid is kept from the second time on
  std::map<Key, ConvexSolid> solids_;
};

}  // namespace frontend
