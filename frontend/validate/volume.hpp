// The volume of a solid by tracing rays through it.
#pragma once

#include <cstdint>

#include "csgcore/subdivision.hpp"

namespace validation {

struct VolumeEstimate {
  double volume;  // in cubic world units
  /// Five times its standard error, and what the thickness tolerance may hide: further off is a
  /// correct one less than once in a million times.
  double bound;
  uint64_t rays;
};

/// Some `rays` vertical rays, two at random in each square of a grid over the box, so that a pair's
/// difference tells the error (stratified sampling). The solid must not be empty.
VolumeEstimate estimate_volume(const csgcore::Subdivision& subdivision, uint64_t seed,
                               uint64_t rays);

}  // namespace validation
