#include "heal/faces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/half_space.hpp"
#include "csgcore/polyhedron.hpp"

namespace frontend {

using csgcore::HalfSpace;
using csgcore::Mat3;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;

namespace {

Vec3 cap_center(const Primitive& primitive, uint32_t cap) {
  return Vec3(0, 0, cap == 0 ? primitive.z_min : primitive.z_max);
}

/// The vertices that are on the half-space's boundary but for the file's digits, moved onto it.
std::vector<Vec3> corners_on(const Polyhedron& polyhedron, const Vec3& normal, double offset) {
  // The importer's polyhedra are of unit size.
  constexpr double kOnFace = csgcore::kMeshDigits;
  std::vector<Vec3> corners;
  for (const Vec3& vertex : polyhedron.vertices()) {
    const double depth = offset - glm::dot(normal, vertex);
    if (std::abs(depth) <= kOnFace) corners.push_back(vertex + depth * normal);
  }
  return corners;
}

/// Of a plane's image under the linear map, which may be a mirror: by the cofactors.
Vec3 image_of_normal(const Mat3& map, const Vec3& normal) {
  return glm::normalize(glm::cross(map[1], map[2]) * normal.x +
                        glm::cross(map[2], map[0]) * normal.y +
                        glm::cross(map[0], map[1]) * normal.z);
}

}  // namespace

uint32_t Faces::count(const Primitive& primitive) {
  if (primitive.shape == Shape::kSphere) return 0;
  if (primitive.shape == Shape::kFrustum) return 2;
  return static_cast<uint32_t>(local(primitive).faces.size());
}

Face Faces::at(const Primitive& primitive, uint32_t face) {
  const csgcore::Affine& map = primitive.local_to_world;
  if (primitive.shape == Shape::kFrustum) {
    return {map.point(cap_center(primitive, face)), image_of_normal(map.linear, Vec3(0, 0, 1))};
  }
  const LocalFace& found = local(primitive).faces[face];
  return {map.point(found.center), image_of_normal(map.linear, found.normal)};
}

std::vector<Vec3> Faces::corners(const Primitive& primitive, uint32_t face) {
  std::vector<Vec3> corners;
  if (primitive.shape == Shape::kFrustum) {
    const double radius = face == 0 ? primitive.r_bottom : primitive.r_top;
    for (const Vec3& rim : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, -1, 0)}) {
      corners.push_back(cap_center(primitive, face) + radius * rim);
    }
  } else {
    corners = local(primitive).faces[face].corners;
  }
  for (Vec3& corner : corners) corner = primitive.local_to_world.point(corner);
  return corners;
}

std::optional<uint32_t> Faces::opposite(const Primitive& primitive, uint32_t face) {
  if (primitive.shape == Shape::kFrustum) return 1 - face;
  return local(primitive).faces[face].opposite;
}

bool Faces::is_parallelepiped(const Primitive& primitive) {
  return primitive.shape == Shape::kPolyhedron && local(primitive).is_parallelepiped;
}

Faces::LocalFaces Faces::faces_of(const Polyhedron& polyhedron) {
  LocalFaces result;
  if (polyhedron.half_spaces().size() > kMostComparedFaces) return result;
  for (const HalfSpace& half_space : polyhedron.half_spaces()) {
    const double length = glm::length(half_space.normal);
    LocalFace& face = result.faces.emplace_back();
    face.normal = half_space.normal / length;
    face.corners = corners_on(polyhedron, face.normal, half_space.offset / length);
    face.center = Vec3(0.0);
    for (const Vec3& corner : face.corners) face.center += corner;
    face.center /= static_cast<double>(face.corners.size());
  }
  for (LocalFace& face : result.faces) {
    for (uint32_t i = 0; i < result.faces.size(); ++i) {
      const Vec3& other = result.faces[i].normal;
      if (glm::dot(face.normal, other) < 0 && parallel(face.normal, other)) face.opposite = i;
    }
  }
  const auto has_opposite = [](const LocalFace& face) { return face.opposite.has_value(); };
  result.is_parallelepiped = result.faces.size() == 6 &&
                             std::all_of(result.faces.begin(), result.faces.end(), has_opposite);
  return result;
}

const Faces::LocalFaces& Faces::local(const Primitive& primitive) {
  const Polyhedron* polyhedron = primitive.polyhedron.get();
  if (polyhedron != last_) {
    const auto [entry, is_new] = known_.try_emplace(polyhedron);
    if (is_new) entry->second = faces_of(*polyhedron);
    last_ = polyhedron;
    last_faces_ = &entry->second;
  }
  return *last_faces_;
}

bool parallel(const Vec3& unit_a, const Vec3& unit_b) {
  return glm::length(glm::cross(unit_a, unit_b)) <= kParallel;
}

}  // namespace frontend
