// Triangle meshes: solids of any shape, as OpenSCAD's polyhedron(), imported files and height
// fields give them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/color.hpp"
#include "csgcore/geometry.hpp"

namespace csgcore {

/// An immutable solid in local coordinates that is bounded by triangles, with a bounding volume
/// hierarchy (BVH) over them. Meshes are large, and primitives share them.
///
/// The mesh is *closed* if each edge is passed as often in one direction as in the other. Then the
/// solid is where the winding number is not 0: a mesh that is inside out is the same solid,
/// overlapping shells are united, and a shell of the other orientation within one is a cavity.
/// A mesh that is not closed has no inside of its own. NUMERICS.md, "Meshes", defines what a ray
/// sees of it.
///
/// Canonical space is given by x_local = center + scale · x_canonical, coordinate by coordinate.
/// There the mesh lies in the unit ball.
class TriangleMesh {
 public:
  /// Indices of vertices, counterclockwise as seen from outside.
  using Triangle = std::array<uint32_t, 3>;

  struct Canonical {
    Vec3 center, scale;
  };

  /// A node of the BVH. Its box holds its triangles in canonical space, and more by kBoxMargin.
  struct Node {
    std::array<float, 3> min, max;
    /// A leaf has triangles()[first] and the next `count`. A branch (count = 0) has the children
    /// nodes()[first] and nodes()[first + 1].
    uint32_t first;
    uint32_t count;
  };
  /// The boxes of nodes are larger than need be by this, in canonical units: far more than the
  /// rounding of float in a test of a ray against them.
  static constexpr float kBoxMargin = 0x1p-20f;
  /// The most triangles of a leaf.
  static constexpr uint32_t kLeafTriangles = 4;

  /// The plane normal · x = offset of a triangle in canonical space. The normal points outwards and
  /// has unit length there. A triangle without an area has some normal that is perpendicular to its
  /// longest edge.
  struct Plane {
    Vec3 normal;
    double offset;
  };

  /// Makes a mesh. Vertices at the same place must be one vertex; all must be finite and are at
  /// least one. Triangles that name a vertex twice are left out; the others get another order. If
  /// the mesh is not closed, triangles are turned so that neighbours across an edge which only they
  /// share agree, by the majority of each connected part. `colors` are those of the triangles;
  /// empty: no face has a colour of its own.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
               std::vector<std::optional<Color>> colors = {});

  /// The solid's definition in local coordinates, whose doubles are exact.
  std::span<const Vec3> vertices() const { return vertices_; }
  /// In the order of the BVH's leaves.
  std::span<const Triangle> triangles() const { return triangles_; }

  /// By triangle; empty: no face has a colour of its own.
  std::span<const std::optional<Color>> colors() const { return colors_; }
  /// Returns the colour of the face that is nearest to a canonical point of the surface.
  std::optional<Color> color_at(const Vec3& point_canonical) const;

  /// The edges that are passed more often in one direction than in the other.
  uint64_t open_edges() const { return open_edges_; }
  bool is_closed() const { return open_edges_ == 0; }

  const Canonical& canonical() const { return canonical_; }
  /// By vertex: its place in canonical space, up to rounding.
  std::span<const Vec3> canonical_vertices() const { return canonical_vertices_; }
  /// By triangle.
  std::span<const Plane> planes() const { return planes_; }
  /// The BVH, whose root comes first. Empty if there are no triangles.
  std::span<const Node> nodes() const { return nodes_; }

  /// Visits the triangles of the leaves whose boxes meet a canonical one, by their numbers, until a
  /// visit returns true. Returns whether one has.
  template <typename Visit>
  bool any_near(const Box& box, const Visit& visit) const;
  /// Returns the winding number at a canonical point. On the surface it may be that of either side.
  int winding(const Vec3& point_canonical) const;
  /// Returns the vertex furthest along a direction; both are canonical.
  Vec3 support(const Vec3& direction_canonical) const;

 private:
  void find_canonical();
  void build_bvh();
  void find_planes();

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::optional<Color>> colors_;
  uint64_t open_edges_ = 0;
  Canonical canonical_{Vec3(0.0), Vec3(1.0)};
  std::vector<Vec3> canonical_vertices_;
  std::vector<Plane> planes_;
  std::vector<Node> nodes_;
};

template <typename Visit>
bool TriangleMesh::any_near(const Box& box, const Visit& visit) const {
  std::vector<uint32_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (box.min.x > node.max[0] || box.min.y > node.max[1] || box.min.z > node.max[2] ||
        box.max.x < node.min[0] || box.max.y < node.min[1] || box.max.z < node.min[2]) {
      continue;
    }
    if (node.count == 0) {
      open.insert(open.end(), {node.first, node.first + 1});
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (visit(i)) return true;
    }
  }
  return false;
}

/// Returns whether both are null, or both have the same vertices, triangles and colours.
bool same_mesh(const TriangleMesh* a, const TriangleMesh* b);

}  // namespace csgcore
