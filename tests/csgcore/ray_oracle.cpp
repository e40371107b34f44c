#include "ray_oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace csgcore::checks {
namespace {

LongMat3 absolute(const LongMat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

Real largest_row_sum(const LongMat3& m) {
  const LongVec3 sums = m[0] + m[1] + m[2];
  return std::max({sums.x, sums.y, sums.z});
}

}  // namespace

RayPacket packet_of(std::span<const PivotRay> rays) {
  RayPacket packet;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const PivotRay& ray = rays[lane];
    for (int axis = 0; axis < 3; ++axis) {
      packet.origin[axis][lane] = ray.origin[axis];
      packet.direction[axis][lane] = ray.direction[axis];
    }
    packet.inverse_length2[lane] = 1 / glm::dot(ray.direction, ray.direction);
  }
  return packet;
}

RayOracle::RayOracle(const Primitive& primitive, const Vec3& pivot)
    : primitive_(primitive),
      kind_(test_support::test_kind_of(primitive.shape())),
      world_to_local_(glm::inverse(LongMat3(primitive.local_to_world.linear))),
      pivot_from_local_origin_(LongVec3(pivot) - LongVec3(primitive.local_to_world.translation)),
      size_(kind_.reach_world(primitive)) {
  const LongMat3 local_to_world(primitive.local_to_world.linear);
  condition_ = largest_row_sum(absolute(local_to_world) * absolute(world_to_local_));
  const LongVec3 to_middle = local_to_world * kind_.middle(primitive);
  middle_from_pivot_ = to_middle - pivot_from_local_origin_;
  const LongVec3 translation(primitive.local_to_world.translation);
  coordinates_ = to_middle == LongVec3(0) ? 0 : glm::length(to_middle) + glm::length(translation);
}

Real RayOracle::error_bound(const LongRay& ray) const {
  const Real coordinates = glm::length(ray.origin) + glm::length(middle_from_pivot_);
  return Real(kRoundings * std::numeric_limits<double>::epsilon()) * condition_ *
         (coordinates + size_ + coordinates_);
}

Real RayOracle::Side::gap() const { return outside / glm::length(gradient); }

LongVec3 RayOracle::to_local(const LongVec3& point) const {
  return world_to_local_ * (point + pivot_from_local_origin_);
}

std::vector<RayOracle::Side> RayOracle::sides(const LongVec3& point) const {
  std::vector<Side> sides;
  for (const test_support::Side& side : kind_.sides(primitive_, to_local(point))) {
    sides.push_back({side.outside, glm::transpose(world_to_local_) * side.gradient});
  }
  return sides;
}

RayOracle::Side RayOracle::nearest(const LongVec3& point) const {
  const std::vector<Side> all = sides(point);
  return *std::max_element(all.begin(), all.end(),
                           [](const Side& a, const Side& b) { return a.gap() < b.gap(); });
}

Real RayOracle::gap(const LongVec3& point) const { return nearest(point).gap(); }

void RayOracle::expect_normal(const LongVec3& point, const Vec3& normal, Real reach) const {
  const Real nearest_gap = gap(point);
  Real error = std::numeric_limits<Real>::infinity();
  for (const Side& side : sides(point)) {
    if (side.gap() < nearest_gap - reach) continue;
    const LongVec3 expected = glm::normalize(side.gradient);
    Real spread = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        LongVec3 beside = point;
        beside[axis] += sign * reach;
        spread = std::max(spread, glm::length(glm::normalize(nearest(beside).gradient) - expected));
      }
    }
    error = std::min(error, glm::length(LongVec3(normal) - expected) - 2 * spread);
  }
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  EXPECT_LE(error, Real(kRoundings * kEpsilon) * condition_);
  EXPECT_NEAR(glm::length(normal), 1, kRoundings * kEpsilon);
}

Real RayOracle::outside(const LongRay& ray, Real t) const {
  Real result = -std::numeric_limits<Real>::infinity();
  for (const test_support::Side& side : kind_.sides(primitive_, to_local(ray.at(t)))) {
    result = std::max(result, side.outside);
  }
  return result;
}

/// Returns the t at which the ray is deepest inside, by golden section.
Real RayOracle::lowest(const LongRay& ray, Real low, Real high) const {
  const Real share = (std::sqrt(Real(5)) - 1) / 2;
  Real left = high - share * (high - low), right = low + share * (high - low);
  Real at_left = outside(ray, left), at_right = outside(ray, right);
  for (int step = 0; step < 95; ++step) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - share * (high - low);
      at_left = outside(ray, left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + share * (high - low);
      at_right = outside(ray, right);
    }
  }
  return (low + high) / 2;
}

Real RayOracle::crossing(const LongRay& ray, Real inside, Real outside) const {
  for (int step = 0; step < 70; ++step) {
    const Real middle = (inside + outside) / 2;
    (this->outside(ray, middle) < 0 ? inside : outside) = middle;
  }
  return inside;
}

RayOracle::Segment RayOracle::segment(const LongRay& ray) const {
  const LongVec3 from_middle = ray.origin - middle_from_pivot_;
  const Real closest =
      -glm::dot(from_middle, ray.direction) / glm::dot(ray.direction, ray.direction);
  const Real reach = 2 * size_ / glm::length(ray.direction);
  const Real inside = lowest(ray, closest - reach, closest + reach);
  if (!(outside(ray, inside) < 0)) return {};
  return {crossing(ray, inside, closest - reach), crossing(ray, inside, closest + reach)};
}

Real RayOracle::deepest(const LongRay& ray, const Segment& segment) const {
  return -gap(ray.at(lowest(ray, segment.start, segment.end)));
}

/// Returns how far from the surface the ray is at the computed crossing and, so that it is this
/// crossing and no other, half-way from there to the expected one.
Real RayOracle::error_of_end(const LongRay& ray, Real computed, Real expected) const {
  return std::max(std::abs(gap(ray.at(computed))),
                  std::abs(gap(ray.at((computed + expected) / 2))));
}

double RayOracle::expect_segment(const LongRay& ray, double start, double end) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Segment expected = segment(ray);
  const bool exists = expected.exists();
  Real error = 0;
  if (start < end) {
    EXPECT_TRUE(std::isfinite(start) && std::isfinite(end));
    error = std::max(error_of_end(ray, start, exists ? expected.start : Real(end)),
                     error_of_end(ray, end, exists ? expected.end : Real(start)));
  } else {
    EXPECT_EQ(start, kInfinity);
    EXPECT_EQ(end, -kInfinity);
    if (exists) error = deepest(ray, expected);
  }
  const LongVec3 &o = ray.origin, &d = ray.direction;
  EXPECT_LE(error, error_bound(ray))
      << "[" << start << ", " << end << "] instead of [" << expected.start << ", " << expected.end
      << "] on (" << o.x << ", " << o.y << ", " << o.z << ") + t (" << d.x << ", " << d.y << ", "
      << d.z << ")";
  return double(error / error_bound(ray));
}

}  // namespace csgcore::checks
