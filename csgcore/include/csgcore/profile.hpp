// Profiles: plane figures bounded by lines and curves, which are extruded or revolved to solids.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

namespace csgcore {

using Vec2 = glm::dvec2;

/// An edge of a profile, from the point where the edge before it ends.
struct ProfileEdge {
  enum class Kind : uint8_t {
    kLine,
    kArc,     // of the circle about `control` through the start; at most a half turn
    kBezier,  // quadratic, with the control point `control`
  };
  Kind kind = Kind::kLine;
  bool is_counterclockwise = true;  // an arc's direction
  Vec2 end{0.0};
  Vec2 control{0.0};
};

/// A closed loop: its last edge ends where the first one begins.
using ProfileLoop = std::vector<ProfileEdge>;

/// What lies inside of the loops.
enum class FillRule : uint8_t {
  kEvenOdd,
  kNonZero,  // where the winding number is not 0
};

/// An immutable plane figure, with a bounding volume hierarchy (BVH) over its edges. Solids that
/// are made of it share it.
///
/// The figure's canonical coordinates are given by x = center + half · x_canonical, coordinate by
/// coordinate. There its box is [−1, 1]². Extrusions and revolutions have these canonical spaces:
///   kExtrusion: |z| ≤ 1, and the cross-section at z is the canonical figure scaled by
///     (radius_mid + radius_slope·z) / reach(). So it lies within the frustum of these radii.
///   kRevolution: |z| ≤ 1. The canonical figure's y is z, and the distance from the axis is
///     radii().x + radii().y · x.
class Profile {
 public:
  /// A part of an edge in canonical coordinates, along which both x and y are monotone. At
  /// s in [0, 1] a curve is at
  ///   (a·start + b·control + c·end) / (a + b + c), a = (1 − s)², b = 2s(1 − s)·weight, c = s².
  /// It turns by a quarter at most, or, if it is of a parabola, by less than a half.
  struct Piece {
    Vec2 start, control, end;
    double weight;  // > 0, or 0 for a line, which has no control point

    bool is_line() const { return weight == 0; }
  };

  /// A node of the BVH, for pieces()[begin] up to pieces()[end]. Its box holds them, and more by
  /// kBoxMargin.
  struct Node {
    std::array<float, 2> min, max;
    uint32_t begin, end;
    uint32_t children;  // nodes()[children] and the next one; 0 for a leaf
    bool is_chain;      // each piece begins where the one before it ends; else they are whole loops
  };
  /// The boxes of nodes are larger than need be by this, in canonical units: far more than the
  /// rounding of float in a test of a ray against them.
  static constexpr float kBoxMargin = 0x1p-18f;
  /// The most pieces of a leaf.
  static constexpr uint32_t kLeafPieces = 4;

  /// All coordinates must be finite. Loops may cross themselves and each other. Edges without a
  /// length are left out.
  Profile(std::vector<ProfileLoop> loops, FillRule fill_rule);

  /// The definition, whose doubles are exact.
  std::span<const ProfileLoop> loops() const { return loops_; }
  FillRule fill_rule() const { return fill_rule_; }

  /// Returns whether the figure's box has an area.
  bool has_area() const { return has_area_; }
  /// The least x of the figure, rounded.
  double min_x() const { return min_x_; }
  /// The middle and half the sides of the figure's box.
  const Vec2& center() const { return center_; }
  const Vec2& half() const { return half_; }
  /// The largest distance of the canonical figure from its origin, or a little more.
  double reach() const { return reach_; }
  /// The distances from the y axis, in shares of the largest: that at the box's middle, and half
  /// the box's width.
  const Vec2& radii() const { return radii_; }

  /// Whole loops, piece after piece, in the order of the BVH's leaves. Pieces that meet share the
  /// point, to the last bit.
  std::span<const Piece> pieces() const { return pieces_; }
  /// The BVH, whose root comes first. Empty if there are no pieces.
  std::span<const Node> nodes() const { return nodes_; }

  /// Returns whether a sum of turns makes a point one of the figure.
  bool is_inside(int winding) const {
    return fill_rule_ == FillRule::kNonZero ? winding != 0 : (winding & 1) != 0;
  }
  /// Returns whether the figure contains the canonical point. On an edge it may be
  /// either, but points of the leftmost edges are contained if those to the right of them are.
  bool contains(const Vec2& point) const;
  /// Returns a point of the edges that is furthest along a direction, up to rounding; both are
  /// canonical.
  Vec2 support(const Vec2& direction) const;

 private:
  std::vector<ProfileLoop> loops_;
  FillRule fill_rule_;
  bool has_area_ = false;
  Vec2 center_{0.0}, half_{1.0}, radii_{0.0};
  double min_x_ = 0;
  double reach_ = 1;
  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
};

/// A parameter of a piece, s = end / (start + end).
struct PieceShares {
  double start, end;
};

/// Returns a combination of the three values of a curve at a parameter: that of its coordinates at
/// its start, its control point, and its end.
template <typename Value>
Value curve_value(const Value& start, const Value& control, const Value& end, double weight,
                  const PieceShares& at) {
  const double a = at.start * at.start, b = 2 * at.start * at.end * weight, c = at.end * at.end;
  return (a * start + b * control + c * end) / (a + b + c);
}

inline Vec2 curve_point(const Profile::Piece& piece, const PieceShares& at) {
  return curve_value(piece.start, piece.control, piece.end, piece.weight, at);
}

/// Returns whether both are null, or both have the same loops and fill rule.
bool same_profile(const Profile* a, const Profile* b);

}  // namespace csgcore
