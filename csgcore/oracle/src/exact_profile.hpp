// The exact crossings of rays with extruded and revolved profiles.
//
// In the figure's plane a point of the ray is at (U/S, V/S). Of an extrusion, U, V and S are linear
// in t. Of a revolution, V is linear, S is constant and U is √q with a quadratic q. On the curve of
// an edge a form of U, V and S is 0: of degree 1 for a line, of degree 2 for a circle or a
// parabola. So the ray meets a curve at the roots of a polynomial in t, of degree 2 at most for an
// extrusion and 4 for a revolution, whose coefficients are exact.
//
// Roots are enclosed in steps of a grid (kGridBits), by exact signs. Between roots that are apart,
// the ray is inside or outside; this is decided exactly at one point. So only two crossings at
// almost one place cannot be told from one. They are taken for equal: if they are less than
// ProfileEnd::error apart, which is far less than any displacement that counts.
#pragma once

#include <memory>
#include <vector>

#include "csgcore/profile.hpp"
#include "exact_primitive.hpp"

namespace oracle {

/// The surface of a side is that of its edge, counted over all loops.
inline Surface edge_surface(uint32_t edge) { return Surface(edge + 2); }

/// An end of a ray's part within a profile's solid.
struct ProfileEnd {
  Surface surface;
  ExactRoot t;   // a number of the grid
  double error;  // of t
};

struct ProfileSegment {
  ProfileEnd begin, end;
};

/// The range of a profile's points along a direction. RoundingUp must be on.
Interval range_along(const csgcore::Profile& profile, const Interval& x, const Interval& y);

/// A solid in a target's local space: relative to the middle, magnified by λ.
class ExactProfile {
 public:
  /// RoundingUp must be on.
  ExactProfile(const csgcore::Primitive& primitive, const Vector<Exact>& middle,
               const Exact& magnification);

  /// Returns the parts of the ray's whole line within the solid, in order. The ray's o must be near
  /// the solid.
  std::vector<ProfileSegment> segments(const LocalRay<Exact>& ray) const;
  /// Returns a normal of any length, inwards or outwards, at a local point of a surface.
  Vector<Interval> normal(const Vector<Interval>& point, Surface surface) const;

 private:
  using Polynomial = std::vector<Exact>;
  /// An edge and the form of its curve; see FigureEdge in profile_figure.hpp of the tests.
  struct Edge {
    csgcore::ProfileEdge::Kind kind;
    bool bulges_left;
    Exact start[2], chord[2];
    Exact uu, uv, vv, u, v;
    double min[2], max[2];  // of its box, and somewhat more
  };
  /// The ray's way in the figure's plane.
  struct Way {
    Polynomial u, v, s, z;  // a revolution has q in place of u
  };
  /// A point of it, where `u` is U or √u.
  struct Place {
    Exact u, v, s;
  };
  struct Window {
    double low, high;
  };
  class Grid;

  Edge make_edge(const csgcore::Vec2& start, const csgcore::ProfileEdge& edge) const;
  Way way_of(const LocalRay<Exact>& ray) const;
  Polynomial curve_along(const Edge& edge, const Way& way) const;
  std::optional<Window> window(const LocalRay<Exact>& ray) const;
  bool may_meet(const Edge& edge, const Way& way, const Window& window) const;
  bool is_at(Surface surface, const Way& way, const Exact& t) const;
  int sign_at(const Place& place, const Exact& rest, const Exact& factor) const;
  bool contains(const Way& way, const Exact& t) const;

  bool is_revolution_;
  csgcore::FillRule fill_rule_;
  std::vector<Edge> edges_;
  Vector<Exact> middle_;
  Exact magnification_;
  Exact bottom_, top_;                    // heights relative to the middle, magnified
  Exact height_, bottom_scale_, growth_;  // of an extrusion
  double size_;                           // of the figure
  Vector<double> min_, max_;              // a box of the solid, in the target's local space
};

}  // namespace oracle
