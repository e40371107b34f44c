#include "csgcore/geometry.hpp"

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

}  // namespace csgcore
