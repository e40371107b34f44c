// The volume of a solid by tracing rays through it.
#pragma once

#include <cstdint>

#include "check.hpp"
#include "csgcore/subdivision.hpp"

namespace validation {

struct VolumeEstimate {
  double volume;  // in cubic world units
  /// Five times its standard error, what no ray may have met, and what the thickness tolerance may
  /// hide: further off is a correct one about once in a million times.
  double bound;
  uint64_t rays;
};

/// About so many vertical rays, two at random in each square of a grid over the box, so that a
/// pair's difference tells the error (stratified sampling). After the deadline no further
/// kVolumePass of them are begun.
VolumeEstimate estimate_volume(const csgcore::Subdivision& subdivision, uint64_t seed,
                               uint64_t rays, Clock::time_point deadline, const Progress& progress);

/// Rays of one grid; more make another grid.
constexpr uint64_t kVolumePass = 50'000;

}  // namespace validation
