// Finds the planes that may bound a ray's part within a polyhedron, by doubles with an error bound.
// Intervals and exact numbers then have few planes left to test.
#pragma once

#include <span>
#include <vector>

#include "exact_primitive.hpp"

namespace oracle {

class NearPlanes {
 public:
  /// Tests all of the target's planes. Returns false if the ray certainly has no part within them.
  bool find(const Target<Interval>& target, const LocalRay<Interval>& ray);

  /// Indices in ascending order, of all planes but those that the ray certainly meets outside of
  /// the part that the other planes leave.
  std::span<const uint32_t> planes() const { return planes_; }

 private:
  /// The meeting of the ray with a plane, at lower ≤ t ≤ upper. A ray that is parallel to the
  /// plane, as far as doubles tell, stays on its side of it within these limits.
  enum class Kind : uint8_t { kEnters, kLeaves, kStaysWithin, kStaysOutside };
  struct Meeting {
    Kind kind;
    double lower, upper;
  };

  std::vector<Meeting> meetings_;
  std::vector<uint32_t> planes_;
};

}  // namespace oracle
