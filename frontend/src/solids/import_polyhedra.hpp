// The polyhedra and meshes of a design. Primitives that differ in an affine map only share one: a
// unit cube, a unit sphere of so many fragments, the same faces. Their sizes are in the matrices.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "meshes/face_set.hpp"

namespace frontend {

/// A round primitive that would have more facets is a mesh. A sphere takes as long to make and to
/// draw either way from 2,000 facets to 125,000 ($fn = 46 to 500); a cylinder is drawn 2 to 20
/// times as fast by half-spaces, but takes 0.5 s to make with so many.
constexpr uint64_t kMostHalfSpaces = 1 << 14;
/// To see that a solid is convex takes faces × vertices steps. One that would take more is a mesh:
/// so many steps take 10 ms, and the text of its faces has 75 kB.
constexpr uint64_t kMostConvexitySteps = 1 << 22;
/// OpenSCAD's facets of all different round primitives of a design: so many are made in 1 s, and
/// take 250 MB.
constexpr uint64_t kMostFacets = 1 << 20;
/// Solids of so few facets are in proportion to the text of their nodes, and not counted.
constexpr uint64_t kFewFacets = 16;

/// A solid that is given by its faces: a polyhedron if that is known to be convex, else a mesh.
/// Neither if it is empty.
struct SolidOfFaces {
  std::shared_ptr<const csgcore::Polyhedron> polyhedron;
  std::shared_ptr<const csgcore::TriangleMesh> mesh;
  /// The local solid is of unit size; the real one is larger by this power of two.
  int exponent = 0;
  /// The faces run clockwise, seen from outside.
  bool is_inside_out = false;
  /// One side of a body that is closed but has no volume: it is drawn as a thin sheet.
  std::shared_ptr<const csgcore::TriangleMesh> sheet;
  /// The faces that are seen from outside, and those that are seen from within, which run
  /// counterclockwise in the file. Set for a closed solid that has both, where the pool tells them.
  std::shared_ptr<const csgcore::TriangleMesh> outer_faces, inner_faces;

  bool is_empty() const { return !polyhedron && !mesh; }
  csgcore::Primitive under(const csgcore::Affine& local_to_world) const;
  csgcore::Primitive under(std::shared_ptr<const csgcore::TriangleMesh> faces,
                           const csgcore::Affine& local_to_world) const;
};

class PolyhedronPool {
 public:
  /// `keeps_meshes`: take_meshes() returns OpenSCAD's mesh of every polyhedron that the pool makes.
  /// `tells_inner_faces`: solids have SolidOfFaces::inner_faces.
  PolyhedronPool(bool keeps_meshes, bool tells_inner_faces)
      : keeps_meshes_(keeps_meshes), tells_inner_faces_(tells_inner_faces) {}

  /// Has no polyhedron if the box is empty, flat or infinite.
  csgcore::Primitive box(const csgcore::Box& box, const csgcore::Affine& local_to_world);

  /// The result lives as long as the pool. `unfinite_faces` is increased by the faces that are left
  /// out, since they have coordinates that are no finite numbers. `closes_gaps`: one that is not
  /// closed is, if points are joined that are nearer than some two cells of OpenSCAD's grid.
  const SolidOfFaces& solid(FaceSet faces, uint64_t& unfinite_faces, bool closes_gaps = false);

  /// A valid primitive of a kind that has facets becomes OpenSCAD's polyhedron with that many
  /// fragments (≥ 3), or its mesh. False: it stays as it is, since there would be too many facets.
  bool facet(csgcore::Primitive& primitive, int fragments);

  FacetMeshes take_meshes() { return std::move(meshes_of_); }

 private:
  /// Fragments, and Faceting::unit.
  using FacetedKey = std::pair<int, csgcore::LocalSolid>;

  /// What tells faces from others: their counts, their power of two and two hashes of 64 bits, so
  /// that large ones need not be kept.
  using FacesKey = std::array<uint64_t, 6>;
  static FacesKey key_of(const FaceSet& faces, int exponent, bool closes_gaps);

  const SolidOfFaces& faceted(const Faceting& faceting, int fragments);

  std::shared_ptr<const csgcore::Polyhedron> unit_box_;
  std::map<FacetedKey, SolidOfFaces> faceted_;
  std::map<FacesKey, SolidOfFaces> solids_;
  const bool keeps_meshes_, tells_inner_faces_;
  FacetMeshes meshes_of_;
  uint64_t facets_ = 0;  // of those of more than kFewFacets
};

}  // namespace frontend
