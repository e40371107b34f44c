#include "frontend/render.hpp"

#include <memory>
#include <tuple>

#include "frontend/render_settings.hpp"
#include "frontend/scene_renderer.hpp"

namespace frontend {

csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats) {
  using ScenePointer = std::shared_ptr<const csgcore::Scene>;
  SceneRenderer renderer;
  renderer.load(ScenePointer(ScenePointer(), &scene));  // it outlives the renderer
  return renderer.draw(view, settings, stats);
}

bool draw_the_same(const RenderSettings& a, const RenderSettings& b) {
  const auto what = [](const RenderSettings& s) {
    return std::tuple(s.scheme.background, s.scheme.background_below, s.scheme.front, s.scheme.back,
                      s.scheme.axes, s.from_within, s.shading, s.show, s.technique, s.samples,
                      s.leaf_primitives, s.threshold_px, s.measured_channels, s.depth_and_id,
                      s.shares_from, s.translucency, s.phong_shadows);
  };
  return what(a) == what(b) && a.studio == b.studio;
}

bool draws_studio(const RenderSettings& settings) {
  return settings.shading == Shading::kStudio && settings.show == Show::kSurface &&
         settings.studio.shows_any();
}

bool draws_shadows(const RenderSettings& settings) {
  return draws_studio(settings) || (settings.shading == Shading::kPhong &&
                                    settings.show == Show::kSurface && settings.phong_shadows > 0);
}

}  // namespace frontend
