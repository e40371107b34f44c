#include "arrangement/windings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace csgcore {
namespace {

/// The centre of a triangle: the sum of its points over 3, in homogeneous coordinates.
struct ExactCenter {
  std::array<Wide<14>, 3> x;
  Wide<13> w;
};

ExactCenter center_of(const std::array<const ArrangedPoint*, 3>& triangle) {
  std::array<ExactPoint, 3> points;
  for (size_t i = 0; i < 3; ++i) {
    points[i] = triangle[i]->is_on_grid ? exact_point(triangle[i]->grid) : triangle[i]->exact;
  }
  const auto& [a, b, c] = points;
  ExactCenter result;
  result.w = Wide<13>(a.w * b.w * c.w) + Wide<13>(a.w * b.w * c.w) + Wide<13>(a.w * b.w * c.w);
  for (size_t i = 0; i < 3; ++i) {
    result.x[i] = Wide<14>(a.x[i] * (b.w * c.w)) + Wide<14>(b.x[i] * (c.w * a.w)) +
                  Wide<14>(c.x[i] * (a.w * b.w));
  }
  return result;
}

/// Returns turn() of two corners and the centre; a centre on the line counts as moved a little in u
/// and by far less in v, so that it lies beside each edge of a facet.
int turn_of_center(const GridPoint& a, const GridPoint& b, const ExactCenter& center, int axis) {
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  const Wide<2> du(Int128{b[u] - a[u]});
  const Wide<2> dv(Int128{b[v] - a[v]});
  const auto across = [&](size_t i) {
    return Wide<16>(center.x[i]) - Wide<16>(Wide<2>(Int128{a[i]}) * center.w);
  };
  const int sign = (du * across(v) - dv * across(u)).sign();
  if (sign != 0) return sign;
  return dv.sign() != 0 ? -dv.sign() : du.sign();
}

/// Returns on which side of the plane the centre lies.
int side_of_center(const GridPlane& plane, const ExactCenter& center) {
  Wide<16> sum = -Wide<16>(Wide<2>(plane.offset()) * center.w);
  for (size_t i = 0; i < 3; ++i) {
    sum = sum + Wide<16>(Wide<2>(plane.normal[i]) * center.x[i]);
  }
  return sum.sign();
}

/// The distance within which the rounded centre is not to be trusted.
constexpr double kCenterError = 2 * kPointError;

/// The rounded turn of two corners and the centre, or 0 if rounding may have changed its sign.
int rounded_turn(const Vec3& a, const Vec3& b, const Vec3& center, int axis) {
  const int u = u_axis(axis);
  const int v = v_axis(axis);
  const double du = b[u] - a[u];
  const double dv = b[v] - a[v];
  const double left = du * (center[v] - a[v]);
  const double right = dv * (center[u] - a[u]);
  const double bound = kCenterError * (std::abs(du) + std::abs(dv)) +
                       4 * 0x1p-53 * (std::abs(left) + std::abs(right));
  const double area = left - right;
  return std::abs(area) > bound ? sign_of(area) : 0;
}

/// The same for the side of the plane.
int rounded_side(const GridPlane& plane, const Vec3& center) {
  const Vec3 terms = plane.rounded_normal * (center - to_vec3(plane.point));
  const Vec3 sizes = glm::abs(terms);
  const Vec3 normal = glm::abs(plane.rounded_normal);
  const double height = terms.x + terms.y + terms.z;
  const double bound =
      kCenterError * (normal.x + normal.y + normal.z) + 8 * 0x1p-53 * (sizes.x + sizes.y + sizes.z);
  return std::abs(height) > bound ? sign_of(height) : 0;
}

}  // namespace

Windings::Windings(const Facets& facets) : facets_(facets), order_(facets.facets.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build();
}

void Windings::build() {
  constexpr uint32_t kFew = 4;
  struct Range {
    uint32_t begin;
    uint32_t end;
    uint32_t parent;  // whose second child it is, or kNoPlace
  };
  std::vector<std::array<float, 3>> centers(order_.size());
  for (uint32_t i = 0; i < order_.size(); ++i) {
    const auto corners = facets_.corners(i);
    for (size_t axis = 0; axis < 3; ++axis) {
      centers[i][axis] = static_cast<float>(corners[0][axis] + corners[1][axis] + corners[2][axis]);
    }
  }
  std::vector<Range> open{{0, static_cast<uint32_t>(order_.size()), kNoPlace}};
  while (!open.empty()) {
    const auto [begin, end, parent] = open.back();
    open.pop_back();
    const auto number = static_cast<uint32_t>(nodes_.size());
    if (parent != kNoPlace) nodes_[parent].first = number;
    Node& node = nodes_.emplace_back();
    node.min.fill(std::numeric_limits<float>::infinity());
    node.max.fill(-std::numeric_limits<float>::infinity());
    std::array<float, 3> least = node.min;
    std::array<float, 3> most = node.max;
    for (uint32_t i = begin; i < end; ++i) {
      for (const GridPoint& point : facets_.corners(order_[i])) {
        for (size_t axis = 0; axis < 3; ++axis) {
          // The relative error of float, outwards.
          const auto x = static_cast<float>(point[axis]);
          const float error = std::abs(x) * 0x1p-23f;
          node.min[axis] = std::min(node.min[axis], x - error);
          node.max[axis] = std::max(node.max[axis], x + error);
        }
      }
      for (size_t axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], centers[order_[i]][axis]);
        most[axis] = std::max(most[axis], centers[order_[i]][axis]);
      }
    }
    if (end - begin <= kFew) {
      node.first = begin;
      node.count = end - begin;
      continue;
    }
    node.count = 0;
    size_t axis = 0;
    for (size_t i = 1; i < 3; ++i) {
      if (most[i] - least[i] > most[axis] - least[axis]) axis = i;
    }
    const uint32_t middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) { return centers[a][axis] < centers[b][axis]; });
    open.push_back({middle, end, number});
    open.push_back({begin, middle, kNoPlace});
  }
}

Windings::Numbers Windings::at(const std::array<const ArrangedPoint*, 3>& triangle, int axis,
                               std::span<const uint32_t> over) const {
  const Vec3 center = (triangle[0]->position + triangle[1]->position + triangle[2]->position) / 3.0;
  const ExactCenter* exact = nullptr;
  ExactCenter exact_storage;
  const auto exact_center = [&]() -> const ExactCenter& {
    if (exact == nullptr) {
      exact_storage = center_of(triangle);
      exact = &exact_storage;
    }
    return *exact;
  };
  const auto u = static_cast<size_t>(u_axis(axis));
  const auto v = static_cast<size_t>(v_axis(axis));
  const auto k = static_cast<size_t>(axis);
  const auto is_reached = [&](const Node& node) {
    const auto within = [&](size_t i) {
      const double x = center[static_cast<int>(i)];
      return node.min[i] <= x + kCenterError && node.max[i] >= x - kCenterError;
    };
    return within(u) && within(v) && node.max[k] >= center[axis] - kCenterError;
  };
  const auto crossing = [&](uint32_t facet) {
    const auto corners = facets_.corners(facet);
    const Vec3 a = to_vec3(corners[0]);
    const Vec3 b = to_vec3(corners[1]);
    const Vec3 c = to_vec3(corners[2]);
    const std::array<const Vec3*, 4> round{&a, &b, &c, &a};
    int all = 0;
    for (size_t i = 0; i < 3; ++i) {
      int turn = rounded_turn(*round[i], *round[i + 1], center, axis);
      if (turn == 0) {
        turn = turn_of_center(corners[i], corners[(i + 1) % 3], exact_center(), axis);
      }
      if (turn == 0 || (i > 0 && turn != all)) return 0;
      all = turn;
    }
    // The facet is seen from ahead if its corners turn left.
    const GridPlane plane = facets_.plane(facet);
    int side = rounded_side(plane, center);
    if (side == 0) side = side_of_center(plane, exact_center());
    // The ray goes along the axis: it leaves through a facet whose normal points along it.
    return side == -all ? all : 0;
  };
  Numbers result;
  std::vector<uint32_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const uint32_t number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (!is_reached(node)) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(number + 1);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const uint32_t facet = order_[i];
      if (std::ranges::find(over, facet) != over.end()) continue;
      const int crossed = crossing(facet);
      if (crossed != 0) result.emplace_back(facets_.facets[facet].operand, crossed);
    }
  }
  std::ranges::sort(result);
  size_t kept = 0;
  for (size_t i = 0; i < result.size();) {
    const uint32_t operand = result[i].first;
    int sum = 0;
    for (; i < result.size() && result[i].first == operand; ++i) sum += result[i].second;
    if (sum != 0) result[kept++] = {operand, sum};
  }
  result.resize(kept);
  return result;
}

}  // namespace csgcore
