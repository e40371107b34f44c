// The overlays of OpenSCAD's --view, drawn over a finished picture.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "frontend/camera.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// The colour of edges.
enum class EdgeColor : uint8_t {
  kOpenScad,  // half way from the face's to white, or to the background's
  kContrast,  // black, or white on what is dark: to be seen in every scheme
};

struct Overlays {
  bool axes = false;        // the world's axes, and a small red, green and blue set in the lower
                            // left corner
  bool crosshairs = false;  // the diagonals of a cube around what the camera looks at
  bool edges = false;       // the edges of OpenSCAD's meshes; of what is smooth, its creases and
                            // outlines
  bool scales = false;      // marks and numbers on the axes; no effect without `axes`
  bool grid = false;        // a faint grid on the ground, the plane z = 0
  EdgeColor edge_color = EdgeColor::kOpenScad;
  bool has_gnomon = true;   // `axes` have the small set in the corner
  double grid_line_px = 1;  // the width of the grid's lines: in a coarse picture less than a pixel

  bool any() const { return axes || crosshairs || edges || scales || grid; }
  bool operator==(const Overlays&) const = default;
};

/// Returns the distance of the grid's lines, in world units: a power of ten.
double grid_spacing(const csgcore::View& view, const Camera& camera);

/// Draws the overlays in the scheme's colours, 1 px wide except for edges, where the model is not
/// in front. The edges are drawn over what the image shows of `design`: a primitive of which it
/// keeps no mesh counts as smooth. Precondition: the image has the view's size and, if any overlay
/// is drawn, its measured channels.
void draw_overlays(csgcore::Image& image, const csgcore::View& view, const Camera& camera,
                   const Overlays& overlays, const ColorScheme& scheme,
                   const ImportedDesign& design);

}  // namespace frontend
