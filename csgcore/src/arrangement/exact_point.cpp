#include "arrangement/exact_point.hpp"

namespace csgcore {
namespace {

template <size_t N, size_t M>
Wide<N> narrowed(const Wide<M>& value) {
  Wide<N> result;
  std::copy_n(value.limbs.begin(), N, result.limbs.begin());
  return result;
}

ExactPoint with_positive_weight(ExactPoint point) {
  if (!point.w.is_negative()) return point;
  for (Wide<5>& x : point.x) x = -x;
  point.w = -point.w;
  return point;
}

/// Returns the determinant of the columns, whose first two are normals.
Wide<6> determinant(const std::array<std::array<Wide<2>, 3>, 3>& columns) {
  const auto minor = [&](size_t i, size_t j) {
    return columns[0][i] * columns[1][j] - columns[0][j] * columns[1][i];
  };
  return minor(0, 1) * columns[2][2] + minor(1, 2) * columns[2][0] + minor(2, 0) * columns[2][1];
}

}  // namespace

ExactPoint exact_point(const GridPoint& point) {
  ExactPoint result;
  for (size_t i = 0; i < 3; ++i) result.x[i] = Wide<5>(Int128{point[i]});
  result.w = Wide<4>(Int128{1});
  return result;
}

ExactPoint meet(const GridPoint& a, const GridPoint& b, const GridPlane& plane) {
  // a is `from` above the plane and b `to`; the point divides the edge in that ratio.
  const Int128 from = plane.height(a);
  const Int128 to = plane.height(b);
  ExactPoint result;
  for (size_t i = 0; i < 3; ++i) {
    result.x[i] =
        Wide<5>(Wide<2>(Int128{b[i]}) * Wide<2>(from) - Wide<2>(Int128{a[i]}) * Wide<2>(to));
  }
  result.w = Wide<4>(Wide<2>(from - to));
  return with_positive_weight(result);
}

ExactPoint meet(const GridPlane& p, const GridPlane& q, const GridPlane& r) {
  // Cramer's rule for normal·x = offset: the columns are those of the transposed system.
  const std::array<const GridPlane*, 3> planes{&p, &q, &r};
  std::array<std::array<Wide<2>, 3>, 4> columns;  // x, y, z of the normals; the offsets
  for (size_t i = 0; i < 3; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) columns[axis][i] = Wide<2>(planes[i]->normal[axis]);
    columns[3][i] = Wide<2>(planes[i]->offset());
  }
  const auto& [x, y, z, d] = columns;
  ExactPoint result;
  result.x[0] = narrowed<5>(determinant({y, z, d}));
  result.x[1] = narrowed<5>(determinant({z, x, d}));
  result.x[2] = narrowed<5>(determinant({x, y, d}));
  result.w = narrowed<4>(determinant({x, y, z}));
  return with_positive_weight(result);
}

Vec3 rounded(const ExactPoint& point) {
  const double w = point.w.to_double();
  return {point.x[0].to_double() / w, point.x[1].to_double() / w, point.x[2].to_double() / w};
}

int side(const GridPlane& plane, const ExactPoint& point) {
  Wide<7> sum = -Wide<7>(Wide<2>(plane.offset()) * point.w);
  for (size_t i = 0; i < 3; ++i) sum = sum + Wide<2>(plane.normal[i]) * point.x[i];
  return sum.sign();
}

int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis) {
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  // The determinant of (u, v, w) of the points, along its last row.
  const Wide<14> sum = c.x[u] * (a.x[v] * b.w - b.x[v] * a.w) +
                       c.x[v] * (a.w * b.x[u] - b.w * a.x[u]) +
                       Wide<14>(c.w * (a.x[u] * b.x[v] - b.x[u] * a.x[v]));
  return sum.sign();
}

}  // namespace csgcore
