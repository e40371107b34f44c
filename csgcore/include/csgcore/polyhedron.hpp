// Convex polyhedra as primitives: OpenSCAD's cube and convex polyhedron, and its faceted spheres,
// cylinders and cones.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "csgcore/facets.hpp"

namespace csgcore {

struct Primitive;

/// An immutable convex solid in local coordinates, with data that make its tests against rays and
/// cells cheap. Few of its faces are intersected with a ray, however many it has: the ray is first
/// clipped by a quadric that encloses the solid, and then by faces in a hierarchy, whole branches
/// of which are skipped.
///
/// A polyhedron is large, and primitives share it: 10,000 nut traps have the same one.
///
/// Canonical space is given by x_local = center + scale · x_canonical, coordinate by coordinate.
/// There the enclosing quadric is the sphere or the frustum of canonical_primitive.hpp.
class Polyhedron {
 public:
  /// A node of the hierarchy of faces, in preorder: a half-space normal · x ≤ limit in canonical
  /// space. A leaf (skip = 0) is the half-space of a face. A branch has the next `skip` entries
  /// below it, and its half-space is sufficient for them: a point of the enclosing quadric that
  /// lies in it lies strictly inside all faces below the branch.
  struct Entry {
    Vec3 normal;
    double limit;  // 1 for a face
    uint32_t skip;
    /// The axis that a face's normal is parallel to, in either direction; kNoAxis for other faces
    /// and for branches.
    uint32_t axis = kNoAxis;
    static constexpr uint32_t kNoAxis = 3;
  };

  /// The six faces of a box whose edges are parallel to the axes of canonical space: x_i · below[i]
  /// ≤ 1 and x_i · above[i] ≤ 1, where below[i] < 0 < above[i].
  struct Slabs {
    Vec3 below, above;
  };

  /// The map into canonical space, and the quadric that encloses the solid there tightly.
  struct Canonical {
    Vec3 center, scale;
    bool in_frustum;  // false: the quadric is the unit ball
    double radius_mid = 0, radius_slope = 0;
  };

  /// Makes the solid that is the intersection of the half-spaces. `vertices` are its vertices, up
  /// to rounding. The solid must have an interior and be bounded.
  Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices);
  /// Does the same with a given quadric, which the vertices lie on or in.
  Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices, Canonical canonical);

  /// These return OpenSCAD's faceted sphere and frustum, with the preconditions of facets.hpp.
  static std::shared_ptr<const Polyhedron> sphere(double radius, int fragments);
  static std::shared_ptr<const Polyhedron> frustum(double z_min, double z_max, double r_bottom,
                                                   double r_top, int fragments);
  static std::shared_ptr<const Polyhedron> box(const Box& box);
  /// Returns null if the mesh does not bound one convex solid (see half_spaces(const Mesh&)).
  static std::shared_ptr<const Polyhedron> from(const Mesh& mesh);

  /// The solid's definition in local coordinates, whose doubles are exact.
  const std::vector<HalfSpace>& half_spaces() const { return half_spaces_; }
  /// In local coordinates, up to rounding.
  const std::vector<Vec3>& vertices() const { return vertices_; }

  const Canonical& canonical() const { return canonical_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// None unless the solid is a box that Slabs can describe.
  const std::optional<Slabs>& slabs() const { return slabs_; }

  /// Returns whether the canonical point lies in the closed solid and no face is nearer to it than
  /// `slack`, in canonical units.
  bool contains(const Vec3& point_canonical, double slack = 0) const;
  /// Returns the canonical normal of the face in which the ray from the canonical origin through
  /// the point, which must be a different one, leaves the solid.
  Vec3 face_towards(const Vec3& point_canonical) const;
  /// Returns the vertex furthest along a direction; both are canonical.
  Vec3 support(const Vec3& direction_canonical) const;

 private:
  /// A node of the hierarchy of vertices, in preorder: a vertex (skip = 0), or a branch with the
  /// next `skip` entries below it. Seen from the canonical origin, the vertices below a branch lie
  /// within an angle about `direction`, whose cosine and sine are kept, and no further away than
  /// `reach`.
  struct VertexEntry {
    Vec3 direction;  // of unit length for a branch; the position of a vertex
    double reach = 0, cosine = 0, sine = 0;
    uint32_t skip = 0;
  };
  void list_faces();
  void list_vertices();
  void find_slabs();
  /// Returns the factor by which the enclosing quadric must be scaled to have the point on it.
  double gauge(const Vec3& point_canonical) const;

  std::vector<HalfSpace> half_spaces_;
  std::vector<Vec3> vertices_;
  Canonical canonical_;
  double inner_radius_ = 0;  // of a ball about the canonical origin that lies in the solid
  std::vector<Entry> entries_;
  std::optional<Slabs> slabs_;
  std::vector<VertexEntry> vertex_entries_;
};

/// Returns whether both are null, or both have the same numbers.
bool same_polyhedron(const Polyhedron* a, const Polyhedron* b);

/// Returns the convex polyhedron that OpenSCAD makes of a primitive's local solid; a polyhedron
/// itself. Null if there is none. `fragments` is 3 or more.
std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive, int fragments);

}  // namespace csgcore
