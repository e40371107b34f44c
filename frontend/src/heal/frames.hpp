// The coordinate frames of a file: how its multmatrix nodes nest, and how far the rounding of their
// entries may have moved a point (frontend/HEALING.md).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"
#include "heal/matrix_healing.hpp"

namespace frontend {

/// The coordinates that a multmatrix sets up inside another's.
struct Frame {
  uint32_t parent = 0;
  uint32_t depth = 0;   // 0: the world
  uint32_t errors = 0;  // index of the matrix' errors; 0: the matrix is exact
  csgcore::Affine to_parent;
  csgcore::Affine to_world;
  // A point at distance |x| from this frame's origin is at most point_error + linear_error·|x| from
  // its place in the design, in the world, with the rounding of every matrix up to the world
  // counted.
  double linear_error = 0;
  double point_error = 0;
  double stretch = 1;  // to_world lengthens no vector by more than this factor
};

/// Returns an upper bound of how much the matrix stretches. For a similarity the bound is its scale
/// itself, so that it does not grow along a chain of rotations.
double stretch_bound(const csgcore::Mat3& m);

/// Returns the inverse of a map whose determinant is not 0.
csgcore::Affine inverse_of(const csgcore::Affine& map);

/// All frames of a file; frame 0 is the world.
class FrameTree {
 public:
  FrameTree();
  /// Makes room for `frames` frames.
  void reserve(size_t frames);
  /// Adds a frame inside `parent`, and returns its index.
  uint32_t add(uint32_t parent, const HealedMatrix& matrix);
  const Frame& operator[](uint32_t frame) const { return frames_[frame]; }
  size_t size() const { return frames_.size(); }
  /// Returns whether no matrix in the file has a rounded entry.
  bool exact() const { return errors_.size() == 1; }

  /// Returns the innermost frame that contains both; none if it is more than kMostSteps away.
  std::optional<uint32_t> common(uint32_t a, uint32_t b) const;

  /// Returns how far, per coordinate of `ancestor`, the rounding of the matrices between `ancestor`
  /// and `frame` may have moved the point `local` of `frame`.
  csgcore::Vec3 error_of_point(uint32_t frame, uint32_t ancestor, const csgcore::Vec3& local) const;
  /// Returns the same bound for a vector, the difference of two points.
  csgcore::Vec3 error_of_vector(uint32_t frame, uint32_t ancestor,
                                const csgcore::Vec3& local) const;

  // The most steps from a primitive to a common frame. Climbing costs a step a level, for every
  // pair that may coincide; primitives further away are not compared, so that the time stays in
  // proportion to the file.
  static constexpr uint32_t kMostSteps = 256;

 private:
  struct Errors {
    csgcore::Mat3 linear{0.0};
    csgcore::Vec3 translation{0.0};
  };
  std::vector<Frame> frames_;
  std::vector<Errors> errors_;
};

}  // namespace frontend
