#include "csgcore/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace csgcore {

double Box::diagonal() const { return empty() ? 0.0 : glm::length(size()); }

void Box::merge(const Box& other) {
  min = glm::min(min, other.min);
  max = glm::max(max, other.max);
}

void Box::merge(const Vec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

Box intersection(const Box& a, const Box& b) {
  const Box box{glm::max(a.min, b.min), glm::min(a.max, b.max)};
  return box.empty() ? Box{} : box;
}

double Affine::determinant() const { return glm::determinant(linear); }

bool Affine::finite() const {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!std::isfinite(linear[column][row])) return false;
    }
    if (!std::isfinite(translation[column])) return false;
  }
  return true;
}

Affine compose(const Affine& a, const Affine& b) {
  return {a.linear * b.linear, a.linear * b.translation + a.translation};
}

Mat3 inverse(const Mat3& m) { return glm::inverse(m); }

namespace {

/// The thickness tolerance as a share of the diagonal of the solid's box (NUMERICS.md, "Why 1e-9").
constexpr double kThicknessTolerance = 1e-9;

/// Every cell's function is valid this far beyond the cell, as a fraction of the root box's largest
/// side: 16 times the rounding (2^-24) of a float coordinate in the model's own units, which is how
/// far a renderer in float may misplace a cell's boundary.
constexpr double kOverlap = 0x1p-20;
/// The overlap is at least this fraction of the largest coordinate: some steps of a double there.
constexpr double kCoordinateRounding = 0x1p-50;

}  // namespace

double thickness_tolerance(const Box& solid_bounds) {
  return kThicknessTolerance * solid_bounds.diagonal();
}

double cell_overlap(const Box& solid_bounds) {
  if (solid_bounds.empty()) return 0;
  const Vec3 size = solid_bounds.size();
  const Vec3 reach = glm::max(glm::abs(solid_bounds.min), glm::abs(solid_bounds.max));
  return std::max(kOverlap * std::max({size.x, size.y, size.z}),
                  kCoordinateRounding * std::max({reach.x, reach.y, reach.z}));
}

}  // namespace csgcore
