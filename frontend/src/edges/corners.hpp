// The ends of edges, and which of them are vertices.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "csgcore/geometry.hpp"

namespace frontend {

/// Collects the ends of edges by place. An edge that continues in another of the same direction has
/// no vertex between the two.
class CornerSet {
 public:
  /// Ends that are nearer to each other than `size` are one, most often.
  explicit CornerSet(double size) : size_(size) {}

  /// Adds the end of an edge that leaves `position` along the unit `direction`. `owner` is returned
  /// with the vertex.
  void add(const csgcore::Vec3& position, const csgcore::Vec3& direction, uint32_t owner);

  /// Calls visit(position, owner) for each vertex.
  template <typename Visit>
  void for_each_vertex(Visit visit) const {
    for (const auto& [key, corner] : corners_) {
      if (!corner.is_passed) visit(corner.position, corner.owner);
    }
  }

 private:
  struct Corner {
    csgcore::Vec3 position, direction;
    uint32_t owner;
    bool turns = false;      // an edge has another direction than the first
    bool is_passed = false;  // there are edges in both directions of one line, and no other
  };
  double size_;
  std::map<std::array<int64_t, 3>, Corner> corners_;
};

}  // namespace frontend
