// The directions of a circle that linear conditions leave.
#pragma once

#include <vector>

namespace frontend {

/// Closed arcs of a circle of directions, given by angles in radians.
class CircleArcs {
 public:
  struct Arc {
    double begin = 0, end = 0;  // begin ≤ end ≤ begin + a turn
  };

  /// Makes it the whole circle.
  void reset() {
    arcs_.clear();
    is_whole_ = true;
  }
  /// Leaves of each arc the angles with a·cos + b·sin ≤ c.
  void cut(double a, double b, double c);

  bool is_whole() const { return is_whole_; }
  bool is_empty() const { return !is_whole_ && arcs_.empty(); }
  /// None if it is the whole circle.
  const std::vector<Arc>& arcs() const { return arcs_; }
  /// The sum of the arcs' angles.
  double length() const;

 private:
  std::vector<Arc> arcs_, cut_;  // in order; the latter is a buffer
  bool is_whole_ = true;
  double origin_ = 0;  // the first arc's begin: no arc goes across it
};

}  // namespace frontend
