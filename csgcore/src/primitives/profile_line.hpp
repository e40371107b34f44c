// The crossings of straight lines with profiles, in canonical coordinates.
//
// A vertex lies to the left of a line, or else to the right; this is decided by the same operations
// for both pieces that share it. A piece whose ends lie on different sides is crossed once, and
// another one never or twice. So a loop is crossed to the left as often as to the right, whatever
// rounding has done.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "csgcore/profile.hpp"

namespace csgcore {

inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// The line of the points p with direction × p = offset, for a direction of length 1.
struct ProfileLine {
  Vec2 direction;
  double offset;

  /// The distance of a point from the line, > 0 on its left.
  double height(const Vec2& p) const { return cross(direction, p) - offset; }
  static bool is_left(double height) { return height >= 0; }
  /// The place of the point's foot on the line.
  double along(const Vec2& p) const { return direction.x * p.x + direction.y * p.y; }
};

/// Calls visit(along, turn) where the line crosses the piece: `turn` is by how much the winding
/// number grows there along the line.
template <typename Visit>
void for_each_crossing(const ProfileLine& line, const Profile::Piece& piece, const Visit& visit) {
  const double start = line.height(piece.start), end = line.height(piece.end);
  const bool from_left = ProfileLine::is_left(start), to_left = ProfileLine::is_left(end);
  if (piece.is_line()) {
    if (from_left == to_left) return;
    const double share = start / (start - end);
    visit(line.along(piece.start) * (1 - share) + line.along(piece.end) * share,
          from_left ? 1 : -1);
    return;
  }
  // The heights are start·a² + 2·middle·a·b + end·b² for the shares a and b. The roots have no
  // cancellation in this form.
  const double middle = piece.weight * line.height(piece.control);
  const double square = middle * middle, product = start * end;
  const auto visit_at = [&](double a, double b, int turn) {
    const double largest = std::max(std::abs(a), std::abs(b));
    const PieceShares at =
        largest > 0 ? PieceShares{std::abs(a) / largest, std::abs(b) / largest} : PieceShares{1, 1};
    visit(curve_value(line.along(piece.start), line.along(piece.control), line.along(piece.end),
                      piece.weight, at),
          turn);
  };
  if (from_left != to_left) {
    // The product of the ends' heights is ≤ 0.
    const double root = std::sqrt(std::max(0.0, square - product));
    const bool is_steeper_at_start = (middle >= 0) != from_left;
    if (is_steeper_at_start) {
      visit_at(std::abs(middle) + root, start, from_left ? 1 : -1);
    } else {
      visit_at(end, std::abs(middle) + root, from_left ? 1 : -1);
    }
  } else if (ProfileLine::is_left(middle) != from_left && square > product) {
    const double larger = std::abs(middle) + std::sqrt(square - product);
    visit_at(larger, start, from_left ? 1 : -1);
    visit_at(end, larger, from_left ? -1 : 1);
  }
}

/// Returns the winding number at the place `at` of the line, up to its sign.
int winding_at(const Profile& profile, const ProfileLine& line, double at);

/// Returns a normal of the piece, of any length, at a canonical point on it.
inline Vec2 piece_normal(const Profile::Piece& piece, const Vec2& point) {
  const auto across = [](const Vec2& v) { return Vec2{v.y, -v.x}; };
  const Vec2 chord = across(piece.end - piece.start);
  if (piece.is_line()) return chord;
  // The areas a, b, c of the triangles that the point makes with two of the three points satisfy
  // b² = 4·weight²·a·c on the curve, whose gradient this is.
  const Vec2 from_start = across(piece.control - piece.start);
  const Vec2 to_end = across(piece.end - piece.control);
  const double a = glm::dot(to_end, point - piece.control);
  const double c = glm::dot(from_start, point - piece.start);
  const double b = glm::dot(chord, point - piece.start);
  const double factor = 2 * piece.weight * piece.weight;
  const Vec2 normal = b * chord - factor * (a * from_start + c * to_end);
  return normal == Vec2(0.0) ? chord : normal;
}

}  // namespace csgcore
