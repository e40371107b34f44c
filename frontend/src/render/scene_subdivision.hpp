// The kd-trees of a scene's solids by the command's settings, timed and counted.
#pragma once

#include <map>
#include <optional>

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
  /// as it was at the last call, or after replace().
  struct Found {
    const csgcore::Subdivision& subdivision;
    bool changed;
  };
  Found of(const csgcore::Solid& solid, const PictureRequest& request);

  struct Followed {
    const csgcore::Subdivision& subdivision;
    const csgcore::SubdivisionUpdate& update;
  };
  /// What was made of `before`, if anything was, follows the edit of its tree to `after`; the rest
  /// is forgotten.
  std::optional<Followed> replace(const csgcore::Solid& before, const csgcore::Solid& after,
                                  const csgcore::SceneEdit& edit, csgcore::TreeEdit tree_edit);

  void forget() { made_.clear(); }

 private:
  struct Made {
    csgcore::Subdivision subdivision;
    csgcore::SubdivisionUpdate update;  // that no picture has shown yet
    double update_ms = 0;
    bool is_updated = false;
  };
  std::map<const csgcore::Solid*, Made> made_;
};

/// Fills the statistics of the model's cells.
void count_cells(const csgcore::Subdivision& subdivision, RenderStats& stats);

}  // namespace frontend
