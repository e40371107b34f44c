#include "frontend/render.hpp"

#include <memory>

#include "frontend/scene_renderer.hpp"
#include "render/renderer_choice.hpp"

namespace frontend {

csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats) {
  using ScenePointer = std::shared_ptr<const csgcore::Scene>;
  SceneRenderer renderer;
  renderer.load(ScenePointer(ScenePointer(), &scene));  // it outlives the renderer
  return renderer.draw(view, settings, stats);
}

bool may_draw_by_gl(const RenderSettings& settings) {
  return settings.renderer == RendererKind::kGl ||
         (settings.renderer == RendererKind::kAuto && !why_no_gpu());
}

}  // namespace frontend
