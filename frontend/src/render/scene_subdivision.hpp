// The kd-trees of a scene's solids by the command's settings, timed and counted, and pictures of
// their cells.
#pragma once

#include <map>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/subdivision.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {

csgcore::SubdivisionOptions subdivision_options(const csgcore::View& view,
                                                const RenderSettings& settings);

/// Keeps a kd-tree for each solid that it is asked for.
class SceneSubdivisions {
 public:
  /// Subdivides the solid, or finds what was made of it by the same settings; with a threshold,
  /// divided further where the view needs it (paper §2.3). Reports progress. `changed`: it is not
  /// as it was at the last call.
  struct Found {
    const csgcore::Subdivision& subdivision;
    bool changed;
  };
  Found of(const csgcore::Solid& solid, const PictureRequest& request);

  void forget() { made_.clear(); }

 private:
  std::map<const csgcore::Solid*, csgcore::Subdivision> made_;
};

/// Fills the statistics of the model's cells.
void count_cells(const csgcore::Subdivision& subdivision, RenderStats& stats);

/// Draws the leaf cells that a surface crosses as boxes (paper, figure 5b), without OpenGL but as
/// glrender draws them: the nearest face of the nearest box (from within a box, its far face) in
/// the frame's front colour, and `edge` along the edges. No id.
csgcore::Image cells_picture(const csgcore::Subdivision& subdivision, const csgcore::View& view,
                             const csgcore::FrameSettings& frame, const glm::vec3& edge);

}  // namespace frontend
