// The plane faces of a primitive's local solid, for healing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// A solid with more faces is taken for curved: none of its faces is compared with others.
constexpr uint32_t kMostComparedFaces = 32;

/// A face in local coordinates.
struct PlaneFace {
  csgcore::Vec3 center;  // a point of the plane amid the corners
  csgcore::Vec3 normal;  // unit; it may point outwards or inwards
  /// The face that is parallel to this one, in every affine image.
  std::optional<uint32_t> opposite;
  /// The face's corners among those of all faces: three or more points that span it. An apex has
  /// none. It is compared with nothing, but may be the opposite of a face.
  uint32_t first_corner = 0, corner_count = 0;
};

/// A solid's faces, numbered from 0; at most kMostComparedFaces.
struct PlaneFaces {
  std::vector<PlaneFace> faces;
  std::vector<csgcore::Vec3> corners;

  std::span<const csgcore::Vec3> corners_of(const PlaneFace& face) const {
    return std::span(corners).subspan(face.first_corner, face.corner_count);
  }
  void clear() {
    faces.clear();
    corners.clear();
  }
};

/// Two unit vectors are parallel if their cross product is no longer than this. It is far above the
/// rounding of doubles and far below that of six digits. A vector this near to a plane stays in it
/// under the moves of healing, which are of the order of 1e-6.
constexpr double kParallel = 1e-9;
bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b);

}  // namespace frontend
