#include "render/prepared_scene.hpp"

#include <utility>

#include "csgcore/changed_areas.hpp"

namespace frontend {

using csgcore::Image;

PreparedScene::PreparedScene(std::shared_ptr<const csgcore::Scene> scene)
    : scene_(std::move(scene)),
      primitives_(csgcore::canonical_primitives(*scene_)),
      model_(primitives_, scene_->model) {
  add_layers();
}

PreparedScene::PreparedScene(std::shared_ptr<const csgcore::Scene> scene,
                             const PreparedScene& earlier, const csgcore::SceneEdit& edit)
    : scene_(std::move(scene)),
      primitives_(csgcore::canonical_primitives(*scene_, *earlier.primitives_, edit)),
      model_(primitives_, scene_->model, earlier.model_, edit, edit.model) {
  add_layers();
}

void PreparedScene::add_layers() {
  add_layer(scene_->background, LayerKind::kBackground);
  add_layer(scene_->highlight, LayerKind::kHighlight);
  if (layers_.empty()) return;
  scene_box_ = model_.bounds();
  for (const auto& layer : layers_) scene_box_.merge(layer->solid.bounds());
}

void PreparedScene::add_layer(const csgcore::CsgTree& tree, LayerKind kind) {
  if (!tree.empty()) layers_.push_back(std::make_unique<Layer>(primitives_, tree, kind));
}

csgcore::FrameSettings PreparedScene::frame_settings(const RenderSettings& settings) const {
  csgcore::FrameSettings frame;
  frame.background = color_of(settings.scheme.background);
  frame.front = color_of(settings.scheme.front);
  frame.back = color_of(settings.scheme.back);
  frame.shading = settings.shading;
  frame.measured_channels = settings.measured_channels || !layers_.empty();
  frame.scene_box = scene_box_;
  return frame;
}

Image PreparedScene::draw(SolidRenderer& renderer, const PictureRequest& request) const {
  csgcore::FrameSettings frame = frame_settings(request.settings);
  Image image = renderer.draw_model(model_, frame, request);
  request.stats.edit.pixels = request.stats.edit.pixels_traced = image.rgb.size();
  if (request.settings.show == Show::kCells) return image;
  for (const auto& layer : layers_) {
    frame.front = frame.back = layer_color(layer->kind);
    const SolidRenderer::Sides sides = renderer.draw_sides(layer->solid, frame, request);
    // As in OpenSCAD: of a translucent body the back faces first.
    blend_layer(sides.behind, layer->opacity, scene_box_.diagonal(), image);
    blend_layer(sides.front, layer->opacity, scene_box_.diagonal(), image);
  }
  return image;
}

void PreparedScene::redraw(SolidRenderer& renderer, const PictureRequest& request,
                           const PreparedScene& earlier, const csgcore::SceneEdit& edit,
                           Image& image) const {
  const bool has_layers = !layers_.empty() || !earlier.layers_.empty();
  if (has_layers || request.settings.show == Show::kCells || !renderer.draws_areas()) {
    image = draw(renderer, request);
    return;
  }
  const csgcore::FrameSettings frame = frame_settings(request.settings);
  const std::vector<csgcore::PixelArea> areas =
      changed_areas(earlier.model_, model_, edit, edit.model, request.view, frame);
  renderer.draw_model_areas(model_, frame, request, areas, image);
  request.stats.edit.pixels = image.rgb.size();
  request.stats.edit.pixels_traced = csgcore::count_pixels(areas);
}

}  // namespace frontend
