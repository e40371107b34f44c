// The constrained Delaunay triangulation of points of a plane.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace frontend {

/// A triangulation of the convex hull of points. Triangle t runs counterclockwise along the sides
/// 3t, 3t + 1 and 3t + 2, each of which begins at a vertex.
class DelaunayTriangulation {
 public:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  /// `points` must be sorted by x and then by y, be different, outlive this, and not lie on one
  /// line. `most_steps` bounds the flips of each call of flip_to_delaunay(), and the steps of the
  /// calls of constrain() between two of these.
  DelaunayTriangulation(std::span<const glm::dvec2> points, uint64_t most_steps);

  /// Makes the edge between two vertices one of the triangulation. Returns false, and leaves the
  /// triangulation in between, if a third vertex lies on the edge, another constraint crosses it,
  /// or the steps are used up.
  bool constrain(uint32_t from, uint32_t to);
  /// Makes edges that are no constraints Delaunay's, or as many as the steps allow.
  void flip_to_delaunay();

  uint32_t sides() const { return static_cast<uint32_t>(origin_.size()); }
  uint32_t origin(uint32_t side) const { return origin_[side]; }
  /// The same edge as a side of the triangle beyond it; kNone on the hull.
  uint32_t twin(uint32_t side) const { return twin_[side]; }
  static uint32_t next(uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static uint32_t previous(uint32_t side) { return side % 3 == 0 ? side + 2 : side - 1; }

 private:
  uint32_t target(uint32_t side) const { return origin_[next(side)]; }
  int turn(uint32_t a, uint32_t b, uint32_t c) const;
  uint32_t add_triangle(uint32_t a, uint32_t b, uint32_t c);
  void link(uint32_t side, uint32_t other);
  void sweep();
  void flip(uint32_t side);
  bool is_flippable(uint32_t side) const;
  bool is_delaunay(uint32_t side) const;
  uint32_t side_between(uint32_t a, uint32_t b) const;
  bool find_crossings(uint32_t from, uint32_t to, std::vector<uint32_t>& crossed);
  bool use_step() { return steps_left_ > 0 && --steps_left_ > 0; }

  std::span<const glm::dvec2> points_;
  const uint64_t most_steps_;
  uint64_t steps_left_;
  std::vector<uint32_t> origin_, twin_;  // by side
  std::vector<uint8_t> is_constraint_;   // by side
  std::vector<uint32_t> side_from_;      // by vertex: a side that begins there
};

}  // namespace frontend
