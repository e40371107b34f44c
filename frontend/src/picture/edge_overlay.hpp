// Draws --view=edges: of smooth primitives the lines that a draughtsman would draw, of others the
// edges of OpenSCAD's meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// Finds the primitive that a pixel shows, if OpenSCAD's edges of it are known.
class MeshLookup {
 public:
  /// The design must outlive the lookup.
  explicit MeshLookup(const ImportedDesign& design);

  /// Returns the primitive with that Primitive::id; null if it is smooth, or unknown. It is a mesh,
  /// or a polyhedron with facets_of().
  const csgcore::Primitive* primitive_of(uint32_t id) const {
    return id < primitives_.size() ? primitives_[id] : nullptr;
  }
  /// Returns OpenSCAD's mesh of a polyhedron of primitive_of(), in its local coordinates.
  const FacetMesh& facets_of(const csgcore::Primitive& primitive) const {
    return facets_.at(primitive.polyhedron());
  }

 private:
  const FacetMeshes& facets_;
  std::vector<const csgcore::Primitive*> primitives_;  // by id
};

/// Draws the creases and outlines that the measured channels show, 1 px wide, in a colour half way
/// between the surface's and `background`. A surface that continues smoothly has no edges, whatever
/// primitives it is made of. Primitives that have meshes get their edges from draw_facet_edges():
/// here only what they share with other primitives is drawn. Precondition: the image has its
/// measured channels and the view's size.
void draw_edges(csgcore::Image& image, const csgcore::View& view, Rgb background,
                const MeshLookup& meshes);

/// Draws the edges of the meshes on the faces beside them that are seen, as OpenSCAD's preview does
/// (frontend/OPENSCAD.md, "Edges"). No line is drawn where two primitives meet. Precondition: the
/// image has its measured channels and the view's size.
void draw_facet_edges(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                      const ColorScheme& scheme, const MeshLookup& meshes);

}  // namespace frontend
