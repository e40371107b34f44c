// The triangle mesh for the reference: by brute force over all triangles, in extended precision.
//
// The triangles are drawn in the plane across the ray, where the ray is the origin. A triangle
// winds around it as often as its edges pass the positive half of the first axis, upwards less
// downwards. An edge passes it or does not, whichever triangle asks: the windings of a closed mesh
// cancel. (The tracer takes the signs of edges in a sheared drawing instead, and the exact oracle
// Plücker's coordinates.)
#pragma once

#include <memory>
#include <vector>

#include "csgcore/primitive.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "kinds/local_solid.hpp"

namespace csgcore::reference {

/// A place where a ray passes a triangle.
struct MeshPassage {
  Real t;
  uint32_t triangle;
  int turn;  // by how much the winding number grows there: 1 or −1
};

/// Returns the places where the ray's whole line passes triangles, in order.
std::vector<MeshPassage> passages(const TriangleMesh& mesh, const NearRay& ray);

/// Returns where the winding number is not 0, if the passages cancel. A span's surface is that of
/// the passage's triangle, as MeshSolid numbers it.
std::vector<Span> wound_spans(const std::vector<MeshPassage>& passages);

/// Returns the normal of a triangle, outwards if the mesh is not inside out, of any length.
LongVec3 triangle_normal(const TriangleMesh& mesh, uint32_t triangle);

class MeshSolid final : public LocalSolid {
 public:
  explicit MeshSolid(const Primitive& primitive);

  void add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const override;
  LongVec3 normal(const LongVec3& point, Surface surface) const override;

 private:
  Real sheet_length(const MeshPassage& passage, const NearRay& ray, Real thickness) const;

  const std::shared_ptr<const TriangleMesh> mesh_;
  const glm::mat<3, 3, Real> local_to_world_, world_to_local_;
};

/// The surface of a triangle at an end of a span: `is_turned` if the outward normal there is
/// opposite to the triangle's own.
inline Surface triangle_surface(uint32_t triangle, bool is_turned) {
  return Surface(2 * triangle + (is_turned ? 1 : 0));
}
inline uint32_t triangle_of(Surface surface) { return uint32_t(surface) / 2; }

}  // namespace csgcore::reference
