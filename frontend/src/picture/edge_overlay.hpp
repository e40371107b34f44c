// Draws --view=edges: of smooth primitives the lines that a draughtsman would draw, of others the
// edges of OpenSCAD's meshes.
#pragma once

#include <array>
#include <cstddef>
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

/// The colours of lines that are seen on a picture, whatever its own are.
class ContrastLines {
 public:
  using Color = std::array<uint8_t, 3>;

  /// Keeps the image's colours, over which the lines will be drawn.
  explicit ContrastLines(const csgcore::Image& image) : below_(image.rgb) {}
  Color at(std::size_t pixel) const { return color_on(below_[pixel]); }

  /// Returns black, or white if black would have a contrast of less than 3 (the contrast ratio of
  /// WCAG 2.2) to the colour. The result has at least that.
  static Color color_on(const Color& color);

 private:
  std::vector<Color> below_;
};

/// Draws the creases and outlines that the measured channels show, 1 px wide; without `contrast` in
/// a colour half way between the surface's and the scheme's background. A surface that continues
/// smoothly has no edges, whatever primitives it is made of. Primitives that have meshes get their
/// edges from draw_facet_edges(): here only what they share with other primitives is drawn.
/// Precondition: the image has its measured channels and the view's size.
void draw_edges(csgcore::Image& image, const csgcore::View& view, const ColorScheme& scheme,
                const MeshLookup& meshes, const ContrastLines* contrast);

/// Draws the edges of the meshes on the faces beside them that are seen, as OpenSCAD's preview does
/// (frontend/OPENSCAD.md, "Edges"), but in the colours of `contrast` if that is given. No line is
/// drawn where two primitives meet. Precondition: the image has its measured channels and the
/// view's size.
void draw_facet_edges(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                      const ColorScheme& scheme, const MeshLookup& meshes,
                      const ContrastLines* contrast);

}  // namespace frontend
