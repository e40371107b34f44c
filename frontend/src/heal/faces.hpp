// The plane faces of primitives in the world, for healing.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "base/primitive_traits.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// A plane face in the world.
struct Face {
  csgcore::Vec3 center;  // a point of the plane amid the corners
  csgcore::Vec3 normal;  // unit; a mirror keeps the side to which it points in local space
};

Face face_in_world(const PlaneFace& face, const csgcore::Affine& local_to_world);

/// Finds the faces of primitives. Keeps those of polyhedra and meshes by their addresses, so that
/// these must outlive this object.
class Faces {
 public:
  /// Returns the primitive's faces in local coordinates; valid until the next call.
  const PlaneFaces& of(const csgcore::Primitive& primitive);
  /// Returns the face under the primitive's present matrix.
  Face at(const csgcore::Primitive& primitive, uint32_t face) {
    return face_in_world(of(primitive).faces[face], primitive.local_to_world);
  }

 private:
  std::unordered_map<const void*, PlaneFaces> known_;
  const void* last_ = nullptr;  // so that a run of cubes is looked up once
  const PlaneFaces* last_faces_ = nullptr;
  PlaneFaces found_;  // faces of the last primitive that is neither
};

}  // namespace frontend
