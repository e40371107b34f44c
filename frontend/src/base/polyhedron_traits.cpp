// The convex polyhedron's traits.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/primitive_traits.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Vec3;

/// Adds the vertices that lie on the half-space's boundary, but for the file's digits, moved onto
/// it.
void add_corners(const Polyhedron& polyhedron, const Vec3& normal, double offset,
                 std::vector<Vec3>& corners) {
  // The importer's polyhedra have unit size, so that this share is also a length.
  constexpr double kOnFace = csgcore::kMeshDigits;
  for (const Vec3& vertex : polyhedron.vertices()) {
    const double depth = offset - glm::dot(normal, vertex);
    if (std::abs(depth) <= kOnFace) corners.push_back(vertex + depth * normal);
  }
}

class PolyhedronTraits final : public PrimitiveTraits {
 public:
  double extent(const Primitive& primitive) const override {
    const Polyhedron::Canonical& canonical = primitive.polyhedron()->canonical();
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, std::abs(canonical.center[axis]) + canonical.scale[axis]);
    }
    return extent;
  }

  Box faceted_box(const Primitive& primitive, const csgcore::FacetSettings&) const override {
    Box box;
    for (const Vec3& vertex : primitive.polyhedron()->vertices()) box.merge(vertex);
    return box;
  }

  /// Faces are numbered as half-spaces are; their normals point outwards.
  void find_plane_faces(const Primitive& primitive, PlaneFaces& result) const override {
    const Polyhedron& polyhedron = *primitive.polyhedron();
    if (polyhedron.half_spaces().size() > kMostComparedFaces) return;
    for (const csgcore::HalfSpace& half_space : polyhedron.half_spaces()) {
      const double length = glm::length(half_space.normal);
      PlaneFace& face = result.faces.emplace_back();
      face.normal = half_space.normal / length;
      face.first_corner = static_cast<uint32_t>(result.corners.size());
      add_corners(polyhedron, face.normal, half_space.offset / length, result.corners);
      face.corner_count = static_cast<uint32_t>(result.corners.size()) - face.first_corner;
      face.center = Vec3(0.0);
      for (const Vec3& corner : result.corners_of(face)) face.center += corner;
      face.center /= static_cast<double>(face.corner_count);
    }
    for (PlaneFace& face : result.faces) {
      for (uint32_t i = 0; i < result.faces.size(); ++i) {
        const Vec3& other = result.faces[i].normal;
        if (glm::dot(face.normal, other) < 0 && parallel(face.normal, other)) face.opposite = i;
      }
    }
  }
};

constexpr PolyhedronTraits kPolyhedronTraits;

}  // namespace

constinit const PrimitiveTraits& Polyhedron_traits = kPolyhedronTraits;

}  // namespace frontend
