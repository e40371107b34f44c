// Maps and places of primitives that are hard on the arithmetic of rays.
#pragma once

#include <glm/geometric.hpp>

#include "checks.hpp"

namespace csgcore::checks {

enum class MapKind { kIdentity, kWhole, kTurned, kMirrored, kAny, kSheared, kNeedle, kPlate };
inline constexpr int kMapKinds = 8;

inline Mat3 turned(std::mt19937& random) {
  const Vec3 x = checks::random_direction(random);
  const Vec3 y = glm::normalize(glm::cross(x, checks::random_direction(random)));
  return {x, y, glm::cross(x, y)};
}

inline Mat3 random_map(MapKind kind, std::mt19937& random) {
  switch (kind) {
    case MapKind::kIdentity:
      return Mat3{1.0};
    case MapKind::kWhole:
      return Mat3{0, 1, 0, 0, 0, 1, 1, 0, 0};
    case MapKind::kTurned:
      return turned(random);
    case MapKind::kMirrored:
      return turned(random) * Mat3{-1, 0, 0, 0, 1, 0, 0, 0, 1};
    case MapKind::kAny:
      return test_support::random_affine(random).linear;
    case MapKind::kSheared:
      return turned(random) * Mat3{1, 0, 0, 3, 1, 0, -2, 20, 1};
    case MapKind::kNeedle:
      return turned(random) * Mat3{1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1};
    case MapKind::kPlate:
      return turned(random) * Mat3{1, 0, 0, 0, 0.5, 0, 0, 0, 1e-6};
  }
  return Mat3{1.0};
}

struct Placement {
  const char* name;
  double size;        // the primitive's size, up to its own numbers
  double from_pivot;  // distance of its local origin from the pivot
  double from_world;  // distance of the pivot from the world's origin
};
inline constexpr Placement kPlacements[] = {{"unit", 1, 0, 0},
                                            {"aside", 1, 10, 3},
                                            {"tiny in a large model", 1e-9, 1, 0},
                                            {"tiny", 1e-9, 1e-9, 1e-9},
                                            {"huge", 1e12, 1e12, 1e12},
                                            {"far from the world's origin", 1, 1, 1e12}};

/// Returns the place of a primitive: its map, and translation relative to the pivot.
inline Affine placed(const Placement& placement, MapKind map, const Vec3& pivot,
                     std::mt19937& random) {
  const Mat3 linear = placement.size * random_map(map, random);
  return {linear, pivot + placement.from_pivot * random_direction(random)};
}

}  // namespace csgcore::checks
