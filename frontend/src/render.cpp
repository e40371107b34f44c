// The drawing of a scene by one renderer or the other: the model, and over it the translucent `%`
// and `#` parts.
#include "frontend/render.hpp"

#include "elapsed.hpp"
#include "renderer_choice.hpp"
#include "scene_scale.hpp"
#include "solid_renderer.hpp"
#include "translucent_layer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Solid;

/// The trees of a scene, made ready once and drawn by any renderer.
class ScenePicture {
 public:
  ScenePicture(const csgcore::Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        settings_(settings),
        primitives_(csgcore::canonical_primitives(scene)),
        model_(primitives_, scene.model) {
    frame_.background = color_of(settings.scheme.background);
    frame_.front = color_of(settings.scheme.front);
    frame_.back = color_of(settings.scheme.back);
    frame_.shading = settings.shading;
    frame_.measured_channels = settings.measured_channels;
    if (scene.background.empty() && scene.highlight.empty()) return;
    frame_.measured_channels = true;
    frame_.scene_box = model_.bounds();
    for (const auto* tree : {&scene.background, &scene.highlight}) {
      frame_.scene_box.merge(Solid(primitives_, *tree).bounds());
    }
  }

  Image draw(SolidRenderer& renderer) const {
    Image image = renderer.draw_model(model_, frame_);
    if (settings_.show == Show::kCells) return image;
    draw_layer(renderer, scene_.background, LayerKind::kBackground, image);
    draw_layer(renderer, scene_.highlight, LayerKind::kHighlight, image);
    return image;
  }

 private:
  void draw_layer(SolidRenderer& renderer, const csgcore::CsgTree& tree, LayerKind kind,
                  Image& image) const {
    if (tree.empty()) return;
    const Solid solid(layer_primitives(primitives_, kind), tree);
    csgcore::FrameSettings frame = frame_;
    frame.front = frame.back = layer_color(kind);
    const SolidRenderer::Sides sides = renderer.draw_sides(solid, frame);
    // openscad.md §4: of a translucent body the back faces first.
    const LayerOpacity opacity(solid, kind);
    const double scene_size = frame_.scene_box.diagonal();
    blend_layer(sides.behind, opacity, scene_size, image);
    blend_layer(sides.front, opacity, scene_size, image);
  }

  const csgcore::Scene& scene_;
  const RenderSettings& settings_;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  Solid model_;
  csgcore::FrameSettings frame_;
};

Image draw_by_cpu(const ScenePicture& picture, const csgcore::View& view,
                  const RenderSettings& settings, RenderStats& stats) {
  return picture.draw(*make_cpu_renderer(view, settings, stats));
}

Image draw_by_gl(const ScenePicture& picture, const csgcore::View& view,
                 const RenderSettings& settings, RenderStats& stats) {
  return picture.draw(*make_gl_renderer(view, settings, stats));
}

Image draw_by_best(const ScenePicture& picture, const csgcore::View& view,
                   const RenderSettings& settings, RenderStats& stats, const GpuFolders& folders) {
  if (const std::optional<std::string> reason = why_no_gpu(folders)) {
    stats.reason = *reason;
    return draw_by_cpu(picture, view, settings, stats);
  }
  const RenderStats before = stats;
  const Clock::time_point start = Clock::now();
  try {
    return draw_by_gl(picture, view, settings, stats);
  } catch (const GlFailure& failure) {
    stats = before;
    stats.context_ms = ms_since(start);
    stats.reason = failure.reason();
  }
  return draw_by_cpu(picture, view, settings, stats);
}

Image draw(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
           RenderStats& stats, const GpuFolders& folders) {
  const Clock::time_point start = Clock::now();
  const ScenePicture picture(scene, settings);
  stats.primitives = scene.primitives.size();
  stats.prepare_ms = ms_since(start);
  switch (settings.renderer) {
    case RendererKind::kCpu:
      return draw_by_cpu(picture, view, settings, stats);
    case RendererKind::kGl:
      return draw_by_gl(picture, view, settings, stats);
    case RendererKind::kAuto:
      break;
  }
  return draw_by_best(picture, view, settings, stats, folders);
}

}  // namespace

Image render(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats, const GpuFolders& folders) {
  stats = {};
  const int exponent = scale_exponent(scene);
  if (exponent == 0) return draw(scene, view, settings, stats, folders);
  Image image = draw(scaled(scene, exponent), scaled(view, exponent), settings, stats, folders);
  undo_scale(exponent, image);
  return image;
}

Image render(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats) {
  return render(scene, view, settings, stats, GpuFolders{});
}

}  // namespace frontend
