// The triangle mesh under affine maps. triangle_mesh.hpp describes its canonical space.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "base/constants.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

/// The cell as a box around the canonical parallelepiped, with its slack.
Box box_around(const CanonicalCell& cell) {
  const Vec3 half = cell.half_box() + Vec3(TriangleMesh::kBoxMargin);
  return {cell.center - half, cell.center + half};
}

/// Returns whether the triangle may meet the cell: neither its plane nor a face of the cell
/// separates the two. `to_cell` maps canonical offsets from the cell's centre to shares of its half
/// edges.
bool may_meet(const TriangleMesh& mesh, uint32_t triangle, const CanonicalCell& cell,
              const Mat3& to_cell, double slack) {
  const TriangleMesh::Plane& plane = mesh.planes()[triangle];
  double reach = cell.slack;
  for (int i = 0; i < 3; ++i) reach += std::abs(glm::dot(plane.normal, cell.half[i]));
  if (std::abs(glm::dot(plane.normal, cell.center) - plane.offset) > reach) return false;
  Box shares;
  for (const uint32_t vertex : mesh.triangles()[triangle]) {
    shares.merge(to_cell * (mesh.canonical_vertices()[vertex] - cell.center));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (shares.min[axis] > 1 + slack || shares.max[axis] < -1 - slack) return false;
  }
  return true;
}

class MeshKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    return primitive.mesh() != nullptr && !primitive.mesh()->triangles().empty();
  }

  bool has_same_solid(const Primitive& a, const Primitive& b) const override {
    return same_mesh(a.mesh(), b.mesh());
  }
  bool has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const override {
    return same_mesh(a.mesh(), b.mesh());
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    const TriangleMesh& mesh = *primitive.mesh();
    const TriangleMesh::Canonical& canonical = mesh.canonical();
    CanonicalPrimitive result;
    result.shared_shape = primitive.as<MeshShape>().mesh;
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point(canonical.center);
    for (int i = 0; i < 3; ++i) result.canonical_to_world[i] = linear[i] * canonical.scale[i];
    result.world_to_canonical = inverse(result.canonical_to_world);
    return result;
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    const TriangleMesh& mesh = *primitive.mesh();
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    if (may_cross(mesh, cell)) return Classification::kCrosses;
    // Without a face in the cell, all of it lies on one side. Sheets are on both sides of a face.
    if (!mesh.is_closed()) return Classification::kCrosses;
    return mesh.winding(cell.center) != 0 ? Classification::kInside : Classification::kOutside;
  }

  /// An open mesh is crossed where its sheets are, but is nothing in itself.
  bool contains(const CanonicalPrimitive& primitive, const Vec3& point) const override {
    return primitive.mesh()->winding(point) != 0;
  }

  Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const override {
    return primitive.mesh()->support(direction);
  }

 private:
  /// Returns whether any triangle may meet the cell.
  static bool may_cross(const TriangleMesh& mesh, const CanonicalCell& cell) {
    const double flatness = std::abs(glm::determinant(cell.half));
    const bool is_flat = !(flatness > 0);
    const Mat3 to_cell = is_flat ? Mat3(0.0) : glm::inverse(cell.half);
    // As a share of the half edges; a flat cell is judged by its box alone.
    double slack = kCanonicalSlack;
    for (int i = 0; i < 3; ++i) {
      slack = std::max(slack, cell.slack * glm::length(glm::transpose(to_cell)[i]) * 2);
    }
    return mesh.any_near(box_around(cell), [&](uint32_t triangle) {
      return is_flat || may_meet(mesh, triangle, cell, to_cell, slack);
    });
  }
};

constexpr MeshKind kMeshKind;

}  // namespace

constinit const PrimitiveKind& Mesh_kind = kMeshKind;

}  // namespace csgcore
