// Convex polyhedra as primitives: OpenSCAD's cube and convex polyhedron, and its faceted spheres,
// cylinders and cones.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "csgcore/half_space.hpp"

namespace csgcore {

/// A convex solid in local coordinates, immutable, with what makes rays and cells cheap. However
/// many faces it has, a ray is cut by few of them: it is first cut by a quadric that encloses the
/// solid, and then by faces in a hierarchy, of which whole branches are passed over.
///
/// Primitives share it: it is large, and 10,000 nut traps have the same.
///
/// Canonical space: x_local = center + scale · x_canonical, by coordinate. There the enclosing
/// quadric is that of canonical_primitive.hpp for a sphere or a frustum.
class Polyhedron {
 public:
  /// A half-space of the hierarchy, in canonical space. Of a face (skip = 0) it is the face's own.
  /// Of a branch it is implied by the faces in the branch's place: a point of the enclosing quadric
  /// that lies within it lies within all of the branch's faces, and not on them. The branch's
  /// entries are the next `skip`.
  struct Entry {
    Vec3 normal;
    double limit;  // normal · x ≤ limit; of a face 1
    uint32_t skip;
    /// The axis along which the normal points, to either side; kNoAxis if it leans.
    uint32_t axis = kNoAxis;
    static constexpr uint32_t kNoAxis = 3;
  };

  /// The six faces of a box whose edges lie along the axes of canonical space, as factors of its
  /// coordinates: x_i · below[i] ≤ 1 and x_i · above[i] ≤ 1, where below[i] < 0 < above[i].
  struct Slabs {
    Vec3 below, above;
  };

  /// Canonical space, and the quadric there that just holds the solid.
  struct Canonical {
    Vec3 center, scale;
    bool in_frustum;  // else in the unit ball
    double radius_mid = 0, radius_slope = 0;
  };

  /// The intersection of the half-spaces, and its vertices, but for rounding. It has an interior,
  /// and is bounded.
  Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices);
  /// With a quadric that the vertices are known to lie on.
  Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices, Canonical canonical);

  /// OpenSCAD's facets of a sphere (see facets.hpp), a frustum; and a box that is not empty.
  static std::shared_ptr<const Polyhedron> sphere(double radius, int fragments);
  static std::shared_ptr<const Polyhedron> frustum(double z_min, double z_max, double r_bottom,
                                                   double r_top, int fragments);
  static std::shared_ptr<const Polyhedron> box(const Box& box);
  /// Null if the mesh does not bound one convex solid (see half_spaces).
  static std::shared_ptr<const Polyhedron> from(const Mesh& mesh);

  /// In local coordinates: the solid's definition, whose doubles are exact.
  const std::vector<HalfSpace>& half_spaces() const { return half_spaces_; }
  /// In local coordinates, but for rounding.
  const std::vector<Vec3>& vertices() const { return vertices_; }

  const Canonical& canonical() const { return canonical_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// None unless the solid is such a box.
  const std::optional<Slabs>& slabs() const { return slabs_; }

  /// Whether the canonical point lies in the solid, closed, and so deep that no face is nearer than
  /// `slack`.
  bool contains(const Vec3& point_canonical, double slack = 0) const;
  /// The canonical normal of the face in which the ray from the canonical origin through the point,
  /// which is another one, leaves the solid.
  Vec3 face_towards(const Vec3& point_canonical) const;
  /// The vertex furthest along a canonical direction.
  Vec3 support(const Vec3& direction_canonical) const;

 private:
  /// A vertex (skip = 0), or a branch: seen from the canonical origin, the next `skip` entries lie
  /// within an angle about an axis, and no further off than `reach`.
  struct VertexEntry {
    Vec3 direction;  // of unit length; a vertex itself
    double reach = 0, cosine = 0, sine = 0;
    uint32_t skip = 0;
  };
  void list_faces();
  void list_vertices();
  void find_slabs();
  /// The factor by which the enclosing quadric grows until the point lies on it.
  double gauge(const Vec3& point_canonical) const;

  std::vector<HalfSpace> half_spaces_;
  std::vector<Vec3> vertices_;
  Canonical canonical_;
  double inner_radius_ = 0;  // of a ball about the canonical origin within the solid
  std::vector<Entry> entries_;
  std::optional<Slabs> slabs_;
  std::vector<VertexEntry> vertex_entries_;
};

/// Whether both are null, or the same solid, number by number.
bool same_polyhedron(const Polyhedron* a, const Polyhedron* b);

}  // namespace csgcore
