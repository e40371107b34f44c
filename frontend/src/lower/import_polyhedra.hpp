// The polyhedra of a design. Primitives that differ in an affine map only share one: a unit cube, a
// unit sphere of so many fragments. Their sizes are in the matrices.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/primitive_traits.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/primitive.hpp"
#include "lower/import_arguments.hpp"

namespace frontend {

/// Large polyhedra that OpenSCAD's facets make have no more faces than this in all of a design:
/// a sphere has $fn²/2. So many spheres' are built in 0.2 s, frusta's in 4 s, and take 70 MB.
constexpr uint64_t kMostFacets = 1 << 17;
/// Those of so few faces are in proportion to the text of their nodes, and not counted.
constexpr uint64_t kFewFacets = 16;
/// To see that a polyhedron is convex takes faces × vertices steps; with more it is not looked at.
/// So many take about a second.
constexpr uint64_t kMostConvexitySteps = 1 << 28;

/// What has become of a polyhedron node.
enum class Convexity : uint8_t { kConvex, kNothing /* the empty set */, kNot, kTooLarge };

/// Whether the faces run the other way round than OpenSCAD wants them, clockwise seen from outside:
/// the volume that they enclose is negative.
bool faces_inwards(const PolyhedronArguments& arguments);

class PolyhedronPool {
 public:
  /// `keeps_meshes`: take_meshes() returns OpenSCAD's mesh of every polyhedron that the pool makes.
  explicit PolyhedronPool(bool keeps_meshes) : keeps_meshes_(keeps_meshes) {}

  /// Has no polyhedron if the box is empty, flat or infinite.
  csgcore::Primitive box(const csgcore::Box& box, const csgcore::Affine& local_to_world);

  /// `primitive` is set if it is kConvex. Without faces it is the empty set.
  Convexity convex(const PolyhedronArguments& arguments, const csgcore::Affine& local_to_world,
                   csgcore::Primitive& primitive);

  /// A valid primitive of a kind that has facets becomes OpenSCAD's polyhedron with that many
  /// fragments (≥ 3). False: it stays as it is, since there would be more than kMostFacets.
  bool facet(csgcore::Primitive& primitive, int fragments);

  FacetMeshes take_meshes() { return std::move(meshes_of_); }

 private:
  using Shared = std::shared_ptr<const csgcore::Polyhedron>;
  /// Fragments, and Faceting::unit.
  using FacetedKey = std::pair<int, LocalSolid>;

  Shared faceted(const Faceting& faceting, int fragments);

  Shared unit_box_;
  std::map<FacetedKey, Shared> faceted_;
  std::map<std::vector<double>, Shared> meshes_;  // by all their numbers; null: not convex
  const bool keeps_meshes_;
  FacetMeshes meshes_of_;
  uint64_t facets_ = 0;  // of those of more than kFewFacets
};

}  // namespace frontend
