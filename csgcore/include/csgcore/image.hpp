// A picture with its measured channels (frontend/OPTIONS.md, "Channels of an OpenEXR picture"), and
// what its pixels see in double.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/geometry.hpp"

namespace csgcore {

constexpr uint32_t kNoPrimitive = 0xFFFFFFFFu;

/// The share of a pixel's light that comes from one primitive's surface, through all that is in
/// front of it.
struct PixelShare {
  uint32_t pixel;
  uint32_t id;  // Primitive::id; kNoPrimitive: of the background
  float share;  // in (0, 1]
};

/// Row-major from the top left corner. `rgb` always holds width·height entries. The measured
/// channels hold as many or, if they were not asked for, none.
struct Image {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<std::array<uint8_t, 3>> rgb;
  std::vector<float> z;             // View's s; +inf at a miss
  std::vector<glm::vec3> normal;    // unit, world space, outward of the solid; 0 at a miss
  std::vector<glm::vec3> position;  // world space; 0 at a miss
  std::vector<uint32_t> id;  // Primitive::id of the surface that is hit; kNoPrimitive at a miss
  /// What pixels show of the ids that were asked for, in the order of pixels, then of ids. None:
  /// nothing translucent was drawn, and each pixel shows what `id` has.
  std::optional<std::vector<PixelShare>> shares;
};

/// Which boundary of the solid a ray shows.
enum class Boundary : uint8_t {
  kFirst,  // where it first enters the solid, or first leaves it if the eye is inside
  kBehind  // the next boundary after kFirst, where the ray leaves the piece (or gap) that it enters
           // there
};

/// What each pixel's centre sees, in double. Row-major from the top left corner.
struct Hits {
  static constexpr uint32_t kMiss = 0xFFFFFFFFu;
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<double> s;            // View's s; +inf at a miss
  std::vector<Vec3> position;       // world space; 0 at a miss
  std::vector<Vec3> normal;         // unit, world space, outward of the solid; 0 at a miss
  std::vector<uint32_t> primitive;  // index into Solid::primitives(); kMiss at a miss
};

}  // namespace csgcore
