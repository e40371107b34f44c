// Plane figures of profiles for the reference: by brute force over all edges, in extended
// precision.
//
// An edge is taken for its chord and what lies between chord and curve. So a point's winding number
// is that of the polygon of the chords, and one more or less for each such part that holds it. (The
// tracer counts crossings of monotone pieces instead.)
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <random>
#include <vector>

#include "csgcore/profile.hpp"
#include "reference.hpp"

namespace csgcore::reference {

using LongVec2 = glm::vec<2, Real>;

/// An edge, and the curve that it is a part of: relative to the edge's start, the points where
///   uu·u² + uv·u·v + vv·v² + u·u + v·v = 0
struct FigureEdge {
  ProfileEdge::Kind kind;
  bool is_counterclockwise;  // an arc's direction
  LongVec2 start, control, end;
  Real uu, uv, vv, u, v;

  bool is_line() const { return kind == ProfileEdge::Kind::kLine; }
  /// Returns the point at a parameter in [0, 1].
  LongVec2 at(Real s) const;
  /// Returns the gradient of the curve's function.
  LongVec2 gradient(const LongVec2& point) const;
  /// Returns the point of the edge that is next to a point.
  LongVec2 nearest(const LongVec2& point) const;
  /// Returns the maximum of dot(x, direction) over the edge.
  Real furthest(const LongVec2& direction) const;
};

class Figure {
 public:
  explicit Figure(const Profile& profile);

  const std::vector<FigureEdge>& edges() const { return edges_; }
  const LongVec2& min() const { return min_; }
  const LongVec2& max() const { return max_; }
  Real size() const { return max_.x - min_.x + max_.y - min_.y; }

  bool contains(const LongVec2& point) const;
  Real furthest(const LongVec2& direction) const;

  /// A place of the boundary, and how far a point is outside of it.
  struct Place {
    size_t edge;
    LongVec2 point;
    Real outside;
    LongVec2 outwards;  // of length 1
  };
  /// Returns the nearest place. Edges on the axis u = 0 may be left out.
  Place nearest(const LongVec2& point, bool without_axis) const;
  /// Returns a random point of an edge, often an end.
  LongVec2 edge_point(std::mt19937& random, bool without_axis) const;
  LongVec2 random_point(std::mt19937& random) const;

 private:
  FillRule fill_rule_;
  std::vector<FigureEdge> edges_;
  LongVec2 min_, max_;
};

/// A polynomial, whose coefficients are in ascending order.
using Polynomial = std::array<Real, 5>;

/// Appends parameters between `low` and `high`, out of order: the polynomial's roots, and some
/// others between which it is monotone.
void append_splits(const Polynomial& polynomial, int degree, Real low, Real high,
                   std::vector<Real>& splits);

}  // namespace csgcore::reference
