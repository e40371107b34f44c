// Random numbers with a sequence for each sample, so that they depend neither on threads nor on the
// standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "csgcore/geometry.hpp"

namespace validation {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
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

}  // namespace validation
