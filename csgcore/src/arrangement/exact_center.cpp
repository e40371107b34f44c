#include "arrangement/exact_center.hpp"

#include <cmath>

namespace csgcore {
namespace {

/// The distance within which a rounded centre is not to be trusted.
constexpr double kCenterError = 2 * kPointError;

ExactCenter center_of(const Facets& facets, const std::array<const ArrangedPoint*, 3>& triangle) {
  std::array<ExactPoint, 3> points;
  for (size_t i = 0; i < 3; ++i) {
    points[i] = exact_point(facets, *triangle[i]);
  }
  const auto& [a, b, c] = points;
  ExactCenter result;
  const Wide<13> w(a.w * b.w * c.w);
  result.w = w + w + w;
  for (size_t i = 0; i < 3; ++i) {
    result.x[i] = Wide<14>(a.x[i] * (b.w * c.w)) + Wide<14>(b.x[i] * (c.w * a.w)) +
                  Wide<14>(c.x[i] * (a.w * b.w));
  }
  return result;
}

/// The sign of (n·δ) for the move δ.
int side_of_moved(const GridPlane& plane) {
  for (const Int128 x : plane.normal) {
    if (x != 0) return sign_of(x);
  }
  return 0;
}

/// The turn of two points and one on their line that is moved.
int turn_of_moved(const GridPoint& a, const GridPoint& b, int axis) {
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  // The turn grows by du·δv − dv·δu.
  const int by_v = sign_of(Int128{b[u] - a[u]});
  const int by_u = -sign_of(Int128{b[v] - a[v]});
  if (u < v) return by_u != 0 ? by_u : by_v;
  return by_v != 0 ? by_v : by_u;
}

}  // namespace

int MovedPoint::turn(const GridPoint& a, const GridPoint& b, int axis) const {
  const int result = csgcore::turn(a, b, point_, axis);
  return result != 0 ? result : turn_of_moved(a, b, axis);
}

int MovedPoint::side(const GridPlane& plane) const {
  const int result = csgcore::side(plane, point_);
  return result != 0 ? result : side_of_moved(plane);
}

MovedCenter::MovedCenter(const Facets& facets, const std::array<const ArrangedPoint*, 3>& triangle)
    : facets_(facets),
      triangle_(triangle),
      position_((triangle[0]->position + triangle[1]->position + triangle[2]->position) / 3.0) {}

const ExactCenter& MovedCenter::exact() const {
  if (!has_exact_) exact_ = center_of(facets_, triangle_);
  has_exact_ = true;
  return exact_;
}

int MovedCenter::turn(const GridPoint& a, const GridPoint& b, int axis) const {
  const int u = u_axis(axis);
  const int v = v_axis(axis);
  const auto i = static_cast<size_t>(u);
  const auto j = static_cast<size_t>(v);
  const auto du = static_cast<double>(b[i] - a[i]);
  const auto dv = static_cast<double>(b[j] - a[j]);
  const double left = du * (position_[v] - static_cast<double>(a[j]));
  const double right = dv * (position_[u] - static_cast<double>(a[i]));
  const double bound = kCenterError * (std::abs(du) + std::abs(dv)) +
                       4 * 0x1p-53 * (std::abs(left) + std::abs(right));
  const double area = left - right;
  if (std::abs(area) > bound) return sign_of(area);
  const auto across = [&](size_t k) {
    return Wide<15>(exact().x[k]) - Wide<2>(Int128{a[k]}) * exact().w;
  };
  const Wide<17> sum =
      Wide<2>(Int128{b[i] - a[i]}) * across(j) - Wide<2>(Int128{b[j] - a[j]}) * across(i);
  return sum.sign() != 0 ? sum.sign() : turn_of_moved(a, b, axis);
}

int MovedCenter::side(const GridPlane& plane) const {
  const Vec3 terms = plane.rounded_normal * (position_ - to_vec3(plane.point));
  const Vec3 sizes = glm::abs(terms);
  const Vec3 normal = glm::abs(plane.rounded_normal);
  const double height = terms.x + terms.y + terms.z;
  const double bound =
      kCenterError * (normal.x + normal.y + normal.z) + 8 * 0x1p-53 * (sizes.x + sizes.y + sizes.z);
  if (std::abs(height) > bound) return sign_of(height);
  Wide<16> sum = -Wide<16>(Wide<2>(plane.offset()) * exact().w);
  for (size_t i = 0; i < 3; ++i) sum = sum + Wide<2>(plane.normal[i]) * exact().x[i];
  return sum.sign() != 0 ? sum.sign() : side_of_moved(plane);
}

}  // namespace csgcore
