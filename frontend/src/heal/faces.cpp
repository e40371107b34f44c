#include "heal/faces.hpp"

#include <cassert>
#include <glm/geometric.hpp>

#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::Vec3;

/// Returns the normal of a plane's image under the linear map, which may be a mirror, by its
/// cofactors.
Vec3 image_of_normal(const Mat3& map, const Vec3& normal) {
  return glm::normalize(glm::cross(map[1], map[2]) * normal.x +
                        glm::cross(map[2], map[0]) * normal.y +
                        glm::cross(map[0], map[1]) * normal.z);
}

void find_faces(const Primitive& primitive, PlaneFaces& faces) {
  traits_of(primitive.shape()).find_plane_faces(primitive, faces);
  assert(faces.faces.size() <= kMostComparedFaces);
}

}  // namespace

Face face_in_world(const PlaneFace& face, const csgcore::Affine& local_to_world) {
  return {local_to_world.point(face.center), image_of_normal(local_to_world.linear, face.normal)};
}

const PlaneFaces& Faces::of(const Primitive& primitive) {
  const void* shared = primitive.polyhedron();
  if (shared == nullptr) shared = primitive.mesh();
  if (shared == nullptr) {
    found_.clear();
    find_faces(primitive, found_);
    return found_;
  }
  if (shared != last_) {
    const auto [entry, is_new] = known_.try_emplace(shared);
    if (is_new) find_faces(primitive, entry->second);
    last_ = shared;
    last_faces_ = &entry->second;
  }
  return *last_faces_;
}

}  // namespace frontend
