// A scene that is drawn again and again: what does not depend on the view is made once.
#pragma once

#include <memory>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"

namespace frontend {

struct GpuFolders;

/// Draws the scene that was loaded last. Belongs to one thread at a time; OpenGL, where it draws,
/// stays with the thread of the first draw.
class SceneRenderer {
 public:
  SceneRenderer();
  /// With the GPUs looked for elsewhere: for tests.
  explicit SceneRenderer(const GpuFolders& folders);
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;

  /// Prepares the scene for drawing, from what was made of the scene before as far as that holds.
  /// Throws Error where its size is beyond what can be drawn; the scene before is then drawn on.
  void load(std::shared_ptr<const csgcore::Scene> scene);

  /// The picture that render() makes of the scene, and its statistics; what was made for an earlier
  /// picture counts with no time. The settings' renderer is that of the first draw.
  /// Precondition: a scene is loaded.
  csgcore::Image draw(const csgcore::View& view, const RenderSettings& settings,
                      RenderStats& stats);

  /// draw(), for a design that is being edited: where the last picture by redraw() had the same
  /// view and settings, only what has changed since is drawn, by the CPU. A picture that is stopped
  /// counts as none.
  csgcore::Image redraw(const csgcore::View& view, const RenderSettings& settings,
                        RenderStats& stats);

  /// What the ray through a point of the picture meets of the model, by the CPU. `x_px` and `y_px`
  /// count from the upper left corner; a pixel's centre is at ½.
  csgcore::Hits pick(const csgcore::View& view, double x_px, double y_px) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontend
