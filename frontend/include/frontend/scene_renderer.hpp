// Draws one scene repeatedly, and reuses what does not depend on the view.
#pragma once

#include <memory>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"

namespace frontend {

struct GlDemands;
struct GpuFolders;

/// Draws the scene that was loaded last. The object belongs to one thread at a time; if it draws by
/// OpenGL, to the thread of the first draw.
class SceneRenderer {
 public:
  SceneRenderer();
  /// For tests: looks for GPUs in other folders, and makes other demands on OpenGL.
  explicit SceneRenderer(const GpuFolders& folders);
  SceneRenderer(const GpuFolders& folders, const GlDemands& demands);
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;

  /// Prepares the scene for drawing. Throws Error if the scene's size is beyond what can be drawn;
  /// the scene before then stays loaded.
  void load(std::shared_ptr<const csgcore::Scene> scene);

  /// Returns the picture that render() makes of the scene, and its statistics, in which reused work
  /// takes no time. The renderer is the one chosen at the first draw, whatever later settings say;
  /// where a picture may not wait for shaders, the CPU draws in place of OpenGL until those that it
  /// needs are there, which another thread compiles. Precondition: a scene is loaded.
  csgcore::Image draw(const csgcore::View& view, const RenderSettings& settings,
                      RenderStats& stats);

  /// Like draw(), for a design that is being edited. If the last picture by redraw() had the same
  /// view and settings, the CPU draws only what has changed since. A picture that was stopped is
  /// not reused.
  csgcore::Image redraw(const csgcore::View& view, const RenderSettings& settings,
                        RenderStats& stats);

  /// Returns what the pixels of a view see of the model, by the CPU and by one thread.
  csgcore::Hits look(const csgcore::View& view) const;

  /// Returns whether a point lies in a primitive of the scene, named by its index.
  bool contains(uint32_t primitive, const csgcore::Vec3& point) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontend
