// Which of many planes may bound a ray's part of a polyhedron: found by doubles with an error
// bound, so that intervals and exact numbers have next to none to look at.
#pragma once

#include <span>
#include <vector>

#include "exact_primitive.hpp"

namespace oracle {

class NearPlanes {
 public:
  /// Looks at all of the target's planes. False if the ray surely has no part within them.
  bool find(const Target<Interval>& target, const LocalRay<Interval>& ray);

  /// Indices in rising order: all planes but those that the ray surely meets outside the part that
  /// others leave of it.
  std::span<const uint32_t> planes() const { return planes_; }

 private:
  /// Where the ray passes a plane: certainly at lower ≤ t ≤ upper. One that is too nearly parallel
  /// to tell stays on its side there.
  enum class Kind : uint8_t { kEnters, kLeaves, kStaysWithin, kStaysOutside };
  struct Meeting {
    Kind kind;
    double lower, upper;
  };

  std::vector<Meeting> meetings_;
  std::vector<uint32_t> planes_;
};

}  // namespace oracle
