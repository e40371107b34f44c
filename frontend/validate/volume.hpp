// Estimates the volume of a solid by tracing rays through it.
#pragma once

#include <cstdint>

#include "check.hpp"
#include "csgcore/subdivision.hpp"

namespace validation {

struct VolumeEstimate {
  double volume;  // in cubic world units
  /// A correct volume is further off about once in a million times. The bound is five times the
  /// standard error, plus what no ray may have met and what the thickness tolerance may hide.
  double bound;
  uint64_t rays;
};

/// Traces about `rays` vertical rays, two at random in each square of a grid over the box, so that
/// the difference of a pair tells the error (stratified sampling). After the deadline no further
/// kVolumePass of them are begun.
VolumeEstimate estimate_volume(const csgcore::Subdivision& subdivision, uint64_t seed,
                               uint64_t rays, Clock::time_point deadline, const Progress& progress);

/// Rays of one grid; for more rays there are several grids.
constexpr uint64_t kVolumePass = 50'000;

}  // namespace validation
