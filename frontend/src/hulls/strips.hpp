// The strips of the hull of round bodies: where a plane that rolls around the hull touches two of
// them.
//
// The tangent planes of two bodies are a circle of them. Each other body leaves of that circle the
// planes that it does not stick out of, which is a linear condition (CircleArcs). At the ends of
// the arcs that all bodies leave, the plane touches a third one. All of that is right up to
// rounding in the plane's direction, where it matters by its square; and a plane that is kept
// although a body sticks out of it, by rounding, adds nothing that is not in the hull.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csgcore/stop_scope.hpp"
#include "hulls/round_bodies.hpp"

namespace frontend {

/// The directions of a circle that linear conditions leave: closed arcs, given by angles in
/// radians.
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

/// Arcs of an angle below this (radians) are no strips: what is missing of a body of radius 1 there
/// is thinner than 2^-49.
constexpr double kLeastStrip = 0x1p-23;

/// Pairs that are looked at, and planes that are compared with a third body: so many take a third
/// of a second.
constexpr uint64_t kMostStripSteps = uint64_t{1} << 22;

/// Looks for the strips of bodies in classes.
template <typename Bodies, typename Visit>
class StripSearch {
 public:
  StripSearch(const Bodies& bodies, const RoundBodies& classes, const Visit& visit)
      : bodies_(bodies), classes_(classes), visit_(visit) {
    for (uint32_t k = 0; k < classes_.bodies.size(); ++k) order_.push_back(k);
    for (uint32_t a = 0; a < classes_.ends.size(); ++a) {
      class_of_.resize(classes_.ends[a], a);
    }
  }

  bool run() {
    const std::vector<uint32_t>& ends = classes_.ends;
    for (size_t a = 0; a < ends.size(); ++a) {
      for (uint32_t i = begin(a); i < ends[a]; ++i) {
        // Two of one class touch one plane only where their centres have a common edge.
        for (const uint32_t j : classes_.neighbors[i]) {
          if (i < j) look_between(i, j);
        }
      }
      for (size_t b = a + 1; b < ends.size(); ++b) {
        for (uint32_t i = begin(a); i < ends[a]; ++i) {
          for (uint32_t j = begin(b); j < ends[b]; ++j) look_between(i, j);
          if (steps_ > kMostStripSteps) return false;
        }
      }
    }
    return steps_ <= kMostStripSteps;
  }

 private:
  uint32_t begin(size_t a) const { return a == 0 ? 0 : classes_.ends[a - 1]; }

  void look_between(uint32_t i, uint32_t j) {
    if (!bodies_.is_round(i) && !bodies_.is_round(j)) return;
    csgcore::stop_point();
    ++steps_;
    const auto circle = bodies_.circle(i, j);
    if (!circle) return;
    arcs_.reset();
    const auto cut = [&](uint32_t k) {
      ++steps_;
      if (k != i && k != j) bodies_.cut(*circle, i, j, k, arcs_);
      return !arcs_.is_empty();
    };
    const auto& neighbors = classes_.neighbors;
    if (!std::all_of(neighbors[i].begin(), neighbors[i].end(), cut)) return;
    if (!std::all_of(neighbors[j].begin(), neighbors[j].end(), cut)) return;
    const auto culprit = std::find_if_not(order_.begin(), order_.end(), [&](uint32_t k) {
      // Their neighbours have spoken for their classes.
      return class_of_[k] == class_of_[i] || class_of_[k] == class_of_[j] || cut(k);
    });
    if (culprit != order_.end()) {
      std::rotate(order_.begin(), culprit, culprit + 1);
    } else {
      visit_(i, j, *circle, arcs_);
    }
  }

  const Bodies& bodies_;
  const RoundBodies& classes_;
  const Visit& visit_;
  std::vector<uint32_t> order_;  // of bodies: those that lately left nothing come first
  std::vector<uint32_t> class_of_;
  CircleArcs arcs_;
  uint64_t steps_ = 0;
};

/// Calls visit(i, j, circle, arcs) for the pairs that have arcs. `Bodies` has is_round(i),
/// circle(i, j) → an optional, and cut(circle, i, j, k, arcs). Pairs of points are left out.
/// Returns false if it has taken kMostStripSteps, and has not ended.
template <typename Bodies, typename Visit>
[[nodiscard]] bool visit_strips(const Bodies& bodies, const RoundBodies& classes,
                                const Visit& visit) {
  return StripSearch(bodies, classes, visit).run();
}

}  // namespace frontend
