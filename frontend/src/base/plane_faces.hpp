// The plane faces of a primitive's local solid, as healing compares them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// A solid of more faces is curved in the design: no face of it is compared with others.
constexpr uint32_t kMostComparedFaces = 32;

/// A face in local coordinates.
struct PlaneFace {
  csgcore::Vec3 center;  // on the plane, amid the corners
  csgcore::Vec3 normal;  // unit; it may point outwards or inwards
  /// The face that is parallel to this one, in every affine image.
  std::optional<uint32_t> opposite;
  /// Its corners among those of all faces: three points or more that span it. An apex has none: it
  /// is compared with nothing, and may be the opposite of a face.
  uint32_t first_corner = 0, corner_count = 0;
};

/// The faces, numbered from 0; no more than kMostComparedFaces.
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

/// Unit vectors, or planes, are parallel if their cross product is no longer: far above the
/// rounding of doubles, far below what six digits write. What is moved by rounding's 1e-6 stays so
/// near to a plane that it runs along.
constexpr double kParallel = 1e-9;
bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b);

}  // namespace frontend
