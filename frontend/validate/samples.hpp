// Makes the rays, views and points that are compared.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"

namespace validation {

/// Random numbers with a sequence for each sample, so that they depend neither on threads nor on
/// the standard library: SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014).
class Random {
 public:
  /// The uses of random numbers. Each has sequences of its own.
  enum class Use : uint64_t {
    kRays,
    kViews,
    kPointsInBox,
    kPointsNearSurfaces,
    kPointsNearEdges,
    kVolume
  };

  Random(uint64_t seed, Use use, uint64_t index) : state_(seed) {
    state_ = next() + static_cast<uint64_t>(use);
    state_ = next() + index;
    state_ = next();
  }

  uint64_t next() {
    uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  /// In [0, 1), from the upper 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  csgcore::Vec3 point_in(const csgcore::Box& box) {
    csgcore::Vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = uniform(box.min[axis], box.max[axis]);
    return point;
  }

  /// A unit vector (Archimedes: z is uniform on a sphere).
  csgcore::Vec3 direction() {
    const double z = uniform(-1, 1), angle = 2 * std::numbers::pi * uniform();
    const double lateral = std::sqrt(1 - z * z);
    return {lateral * std::cos(angle), lateral * std::sin(angle), z};
  }

 private:
  uint64_t state_;
};

/// Returns a random line or ray through the box, as a view of one pixel. Half of them are
/// orthographic, half a perspective from within the box. Precondition: the box is not empty.
csgcore::View random_ray_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// Returns a camera in a random direction that has the box in its picture. Half of them are
/// perspective, half orthographic.
csgcore::View random_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// Returns all pixels of a picture, in an order in which the first ones already lie all over it.
std::vector<uint32_t> scattered_pixels(const csgcore::View& view);

/// Makes points in and about a solid.
class PointSampler {
 public:
  /// `boundary` is the solid's, in triangles; the points do not depend on their order. The box
  /// contains it and is not empty.
  PointSampler(const csgcore::Box& box, const csgcore::Mesh& boundary, uint64_t seed);

  /// Returns a point anywhere in the box.
  csgcore::Vec3 in_box(uint64_t index) const;
  /// Returns a point above or below the boundary. Its distance, as a share of the box's diagonal,
  /// is log-uniform between kNearest and kFurthest. Without a boundary it is anywhere in the box.
  csgcore::Vec3 near_surface(uint64_t index) const;
  /// Returns a point that far from an edge of the boundary, in any direction.
  csgcore::Vec3 near_edge(uint64_t index) const;

  static constexpr double kFurthest = 1e-2;
  static constexpr double kNearest = 1e-7;  // 100 times the tolerance below which pieces do not
                                            // exist

 private:
  using Triangle = std::array<csgcore::Vec3, 3>;
  const Triangle& pick_triangle(Random& random) const;

  csgcore::Box box_;
  std::vector<Triangle> triangles_;
  std::vector<double> areas_;  // cumulative, each triangle included
  uint64_t seed_;
};

}  // namespace validation
