// The solids of a design that take time, each of which is made once: hulls, and the boundaries of
// what operations leave. Hulls that differ in their place only share their polyhedra.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "hulls/generator.hpp"

namespace frontend {

class SolidPool {
 public:
  /// What is kept for later use.
  enum class Keeps : uint8_t {
    kRepeated,  // many solids, and others from the second time on that they are asked for
    kAll,       // for the design's next version
  };
  explicit SolidPool(Keeps keeps = Keeps::kRepeated) : keeps_(keeps) {}

  /// Returns what convex_solid() does. The coordinates are finite. Any threads may call it.
  ConvexSolid solid(const Generators& generators);
  /// Returns what csgcore::boundary_mesh() does. Any threads may call it.
  csgcore::BoundaryMesh boundary(std::span<const csgcore::TriangleSet> operands,
                                 const csgcore::CsgTree& tree);
  /// Forgets the solids that were not asked for since the last call.
  void end_version();
  /// Returns how many solids were made.
  size_t made() const { return made_; }
  size_t boundaries_made() const { return boundaries_made_; }

 private:
  using Key = std::vector<double>;  // the generators, the first one at the origin
  struct Kept {
    ConvexSolid solid;
    bool is_used = true;  // since the last end_version()
  };

  using Content = std::pair<uint64_t, uint64_t>;  // hashes of operands and tree
  struct KeptBoundary {
    csgcore::BoundaryMesh mesh;
    bool is_used = true;
  };

  ConvexSolid made_of(const Generators& generators);
  ConvexSolid shared(const Generators& generators);

  const Keeps keeps_;
  std::atomic<size_t> made_ = 0;
  std::atomic<size_t> boundaries_made_ = 0;
  std::mutex mutex_;       // of all below
  std::set<size_t> seen_;  // hashes of keys that are not kept yet
  std::map<Key, Kept> solids_;
  std::map<Content, KeptBoundary> boundaries_;
  size_t kept_triangles_ = 0;  // of all of them
};

}  // namespace frontend
