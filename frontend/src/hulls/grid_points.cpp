#include <algorithm>
#include <array>
#include <cmath>

#include "hulls/point_hull.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

__extension__ using Wide = __int128;

/// The grid has this many bits on the longest side.
constexpr int kGridBits = 52;

struct WideVector {
  Wide x, y, z;
};

WideVector wide_cross(const GridPoint& u, const GridPoint& v) {
  const auto minor = [](int64_t a, int64_t b, int64_t c, int64_t d) {
    return static_cast<Wide>(a) * d - static_cast<Wide>(b) * c;
  };
  return {minor(u.y, u.z, v.y, v.z), minor(u.z, u.x, v.z, v.x), minor(u.x, u.y, v.x, v.y)};
}

GridPoint difference(const GridPoint& a, const GridPoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

WideVector wide_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return wide_cross(difference(b, a), difference(c, a));
}

/// The sign of a sum of products, each of a number of 107 bits and one of 53.
int sign_of_dot(const WideVector& m, const GridPoint& d) {
  constexpr int kHalf = 64;
  Wide high = 0;
  Wide low = 0;
  const auto add = [&](Wide factor, int64_t other) {
    high += (factor >> kHalf) * other;
    low += static_cast<Wide>(static_cast<uint64_t>(factor)) * other;
  };
  add(m.x, d.x);
  add(m.y, d.y);
  add(m.z, d.z);
  high += low >> kHalf;
  if (high != 0) return high < 0 ? -1 : 1;
  return static_cast<uint64_t>(low) != 0 ? 1 : 0;
}

}  // namespace

PointGrid on_grid(std::span<const Vec3> points) {
  PointGrid grid;
  if (points.empty()) return grid;
  double largest = 0;
  for (const Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(point[axis]));
  }
  // Scaled first, so that no difference overflows.
  const int shift = largest > 0 ? std::ilogb(largest) + 1 : 0;
  const auto scaled = [shift](const Vec3& point) {
    return Vec3(std::ldexp(point.x, -shift), std::ldexp(point.y, -shift),
                std::ldexp(point.z, -shift));
  };
  csgcore::Box box;
  for (const Vec3& point : points) box.merge(scaled(point));
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  const int bits = longest > 0 ? kGridBits - std::ilogb(longest) - 1 : 0;
  grid.origin = Vec3(std::ldexp(box.min.x, shift), std::ldexp(box.min.y, shift),
                     std::ldexp(box.min.z, shift));
  grid.exponent = shift - bits;
  grid.points.reserve(points.size());
  for (const Vec3& point : points) {
    const Vec3 local = scaled(point) - box.min;
    const auto whole = [bits](double x) { return std::llrint(std::ldexp(x, bits)); };
    grid.points.push_back({whole(local.x), whole(local.y), whole(local.z)});
  }
  return grid;
}

Vec3 normal_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const WideVector normal = wide_normal(a, b, c);
  return {static_cast<double>(normal.x), static_cast<double>(normal.y),
          static_cast<double>(normal.z)};
}

int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  return sign_of_dot(wide_normal(a, b, c), difference(d, a));
}

bool are_collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const WideVector normal = wide_normal(a, b, c);
  return normal.x == 0 && normal.y == 0 && normal.z == 0;
}

}  // namespace frontend
