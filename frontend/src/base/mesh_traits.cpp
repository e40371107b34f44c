// The triangle mesh's traits.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "base/primitive_traits.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace frontend {
namespace {

using csgcore::TriangleMesh;
using csgcore::Vec3;

class MeshTraits final : public PrimitiveTraits {
 public:
  double extent(const csgcore::Primitive& primitive) const override {
    const TriangleMesh::Canonical& canonical = primitive.mesh()->canonical();
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, std::abs(canonical.center[axis]) + canonical.scale[axis]);
    }
    return extent;
  }

  /// The planes of the triangles, each once.
  void find_plane_faces(const csgcore::Primitive& primitive, PlaneFaces& result) const override {
    const TriangleMesh& mesh = *primitive.mesh();
    if (mesh.triangles().size() > kMostComparedTriangles) return;
    std::vector<std::vector<Vec3>> corners;
    for (const TriangleMesh::Triangle& triangle : mesh.triangles()) {
      const Vec3 &a = mesh.vertices()[triangle[0]], &b = mesh.vertices()[triangle[1]],
                 &c = mesh.vertices()[triangle[2]];
      const Vec3 normal = glm::cross(b - a, c - a);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      const size_t face = face_with(result, normal / length, a);
      if (face == corners.size()) {
        if (face == kMostComparedFaces) {
          result.clear();
          return;
        }
        PlaneFace& added = result.faces.emplace_back();
        added.center = a;
        added.normal = normal / length;
        corners.emplace_back();
      }
      corners[face].insert(corners[face].end(), {a, b, c});
    }
    add_corners(corners, result);
  }

 private:
  /// Solids with so few faces rarely have more triangles.
  static constexpr size_t kMostComparedTriangles = 512;

  /// Returns the face in whose plane the point and the normal lie, or how many faces there are.
  static size_t face_with(const PlaneFaces& faces, const Vec3& normal, const Vec3& point) {
    // The importer's meshes have unit size, so that this share is also a length.
    constexpr double kInPlane = csgcore::kMeshDigits;
    size_t i = 0;
    while (i < faces.faces.size() &&
           !(parallel(faces.faces[i].normal, normal) &&
             std::abs(glm::dot(normal, point - faces.faces[i].center)) <= kInPlane)) {
      ++i;
    }
    return i;
  }

  static void add_corners(const std::vector<std::vector<Vec3>>& corners, PlaneFaces& result) {
    for (size_t i = 0; i < corners.size(); ++i) {
      PlaneFace& face = result.faces[i];
      face.first_corner = static_cast<uint32_t>(result.corners.size());
      face.corner_count = static_cast<uint32_t>(corners[i].size());
      Vec3 sum(0.0);
      for (const Vec3& corner : corners[i]) {
        sum += corner;
        result.corners.push_back(corner +
                                 glm::dot(face.normal, face.center - corner) * face.normal);
      }
      const Vec3 middle = sum / static_cast<double>(corners[i].size());
      face.center = middle + glm::dot(face.normal, face.center - middle) * face.normal;
    }
  }
};

constexpr MeshTraits kMeshTraits;

}  // namespace

constinit const PrimitiveTraits& Mesh_traits = kMeshTraits;

}  // namespace frontend
