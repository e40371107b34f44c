#include "frontend/render.hpp"

#include <memory>

#include "frontend/scene_renderer.hpp"

namespace frontend {

csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats) {
  using ScenePointer = std::shared_ptr<const csgcore::Scene>;
  SceneRenderer renderer;
  renderer.load(ScenePointer(ScenePointer(), &scene));  // it outlives the renderer
  return renderer.draw(view, settings, stats);
}

}  // namespace frontend
