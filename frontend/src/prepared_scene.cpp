#include "prepared_scene.hpp"

namespace frontend {

using csgcore::Image;

PreparedScene::PreparedScene(const csgcore::Scene& scene)
    : primitives_(csgcore::canonical_primitives(scene)), model_(primitives_, scene.model) {
  add_layer(scene.background, LayerKind::kBackground);
  add_layer(scene.highlight, LayerKind::kHighlight);
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
  if (request.settings.show == Show::kCells) return image;
  for (const auto& layer : layers_) {
    frame.front = frame.back = layer_color(layer->kind);
    const SolidRenderer::Sides sides = renderer.draw_sides(layer->solid, frame, request);
    // openscad.md §4: of a translucent body the back faces first.
    blend_layer(sides.behind, layer->opacity, scene_box_.diagonal(), image);
    blend_layer(sides.front, layer->opacity, scene_box_.diagonal(), image);
  }
  return image;
}

}  // namespace frontend
