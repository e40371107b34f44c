#include "arrangement/grid.hpp"

namespace csgcore {
namespace {

Vec3 rounded(const std::array<Int128, 3>& normal) {
  return {static_cast<double>(normal[0]), static_cast<double>(normal[1]),
          static_cast<double>(normal[2])};
}

}  // namespace

GridPlane plane_through(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  std::array<Int128, 3> p;
  std::array<Int128, 3> q;
  for (size_t i = 0; i < 3; ++i) {
    p[i] = b[i] - a[i];
    q[i] = c[i] - a[i];
  }
  const std::array<Int128, 3> normal{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                                     p[0] * q[1] - p[1] * q[0]};
  return {normal, a, rounded(normal)};
}

GridPlane plane_along(const GridPoint& a, const GridPoint& b, int axis) {
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  std::array<Int128, 3> normal{};
  normal[u] = b[v] - a[v];
  normal[v] = a[u] - b[u];
  return {normal, a, rounded(normal)};
}

}  // namespace csgcore
