// Vectors, axis-aligned boxes and affine maps, all in double: csgcore's precision; and the two
// tolerances that are fitted to a solid's box.
#pragma once

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace csgcore {

using Vec3 = glm::dvec3;
using Mat3 = glm::dmat3;  // column-major, as GLM stores it: m[column][row]

/// Returns the largest coordinate.
inline double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

/// Closed axis-aligned box. A default-constructed box is empty (min > max) and is the identity of
/// `merge`. An empty box has no meaningful center() and size().
struct Box {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  Vec3 center() const { return 0.5 * min + 0.5 * max; }
  Vec3 size() const { return max - min; }
  /// Length of the space diagonal; 0 for an empty box.
  double diagonal() const;
  void merge(const Box& other);
  void merge(const Vec3& point);
};

/// Returns the points that lie in both. An empty result is the default-constructed box.
Box intersection(const Box& a, const Box& b);

/// The affine map x ↦ linear·x + translation.
struct Affine {
  Mat3 linear{1.0};
  Vec3 translation{0.0};

  Vec3 point(const Vec3& p) const { return linear * p + translation; }
  Vec3 direction(const Vec3& d) const { return linear * d; }
  double determinant() const;
  /// True if all 12 entries are finite.
  bool finite() const;
};

/// Returns the map a ∘ b, which applies b first: (a ∘ b)(x) = a(b(x)).
Affine compose(const Affine& a, const Affine& b);

/// Returns the inverse of a matrix whose determinant is not 0.
Mat3 inverse(const Mat3& m);

/// Returns the thickness tolerance τ of a solid with these bounds, in world units. Pieces and gaps
/// that are thinner along the surface normal do not exist (NUMERICS.md, "The definition").
double thickness_tolerance(const Box& solid_bounds);

/// Returns how far beyond a cell its function is valid (Subdivision::overlap), in world units, for
/// a solid with these bounds; 0 if they are empty.
double cell_overlap(const Box& solid_bounds);

}  // namespace csgcore
