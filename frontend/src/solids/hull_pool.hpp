// The convex solids of a design. Those that differ in their place only share their polyhedra.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "hulls/generator.hpp"

namespace frontend {

class HullPool {
 public:
  /// What is kept for later use.
  enum class Keeps : uint8_t {
    kRepeated,  // many solids, and others from the second time on that they are asked for
    kAll,       // for the design's next version
  };
  explicit HullPool(Keeps keeps = Keeps::kRepeated) : keeps_(keeps) {}

  /// Returns what convex_solid() does. The coordinates are finite. Any threads may call it.
  ConvexSolid solid(const Generators& generators);
  /// Forgets the solids that were not asked for since the last call.
  void end_version();
  /// Returns how many solids were made.
  size_t made() const { return made_; }

 private:
  using Key = std::vector<double>;  // the generators, the first one at the origin
  struct Kept {
    ConvexSolid solid;
    bool is_used = true;  // since the last end_version()
  };

  ConvexSolid made_of(const Generators& generators);
  ConvexSolid shared(const Generators& generators);

  const Keeps keeps_;
  std::atomic<size_t> made_ = 0;
  std::mutex mutex_;       // of all below
  std::set<size_t> seen_;  // hashes of keys that are not kept yet
  std::map<Key, Kept> solids_;
};

}  // namespace frontend
