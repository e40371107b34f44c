#include "render/prepared_scene.hpp"

#include <limits>
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
  if (scene_->layers.empty()) return;
  scene_box_ = model_.bounds();
  for (const csgcore::Layer& layer : scene_->layers) {
    layers_.push_back(std::make_unique<const PreparedLayer>(*primitives_, layer));
    model_is_layered_ = model_is_layered_ || layers_.back()->is_of_model();
    scene_box_.merge(layers_.back()->solid().bounds());
  }
}

csgcore::FrameSettings PreparedScene::frame_settings(const RenderSettings& settings) const {
  csgcore::FrameSettings frame;
  frame.background = color_of(settings.scheme.background);
  frame.front = color_of(settings.scheme.front);
  frame.back = color_of(settings.scheme.back);
  if (settings.from_within) frame.from_within = color_of(*settings.from_within);
  frame.shading = settings.shading;
  frame.measured_channels = settings.measured_channels || !layers_.empty();
  frame.scene_box = scene_box_;
  return frame;
}

/// What layers are drawn over. Its measured channels are always the model's.
Image PreparedScene::draw_base(SolidRenderer& renderer, const csgcore::FrameSettings& frame,
                               const PictureRequest& request) const {
  const bool wants_model = !model_is_layered_ || request.settings.measured_channels ||
                           request.settings.show == Show::kCells;
  if (wants_model) return renderer.draw_model(model_, frame, request);
  Image image;
  image.width_px = request.view.width_px;
  image.height_px = request.view.height_px;
  image.rgb.resize(size_t{image.width_px} * image.height_px);
  return image;
}

Image PreparedScene::draw(SolidRenderer& renderer, const PictureRequest& request) const {
  const csgcore::FrameSettings frame = frame_settings(request.settings);
  Image image = draw_base(renderer, frame, request);
  request.stats.edit.pixels = request.stats.edit.pixels_traced = image.rgb.size();
  if (layers_.empty() || request.settings.show == Show::kCells) return image;
  std::vector<float> depth = image.z;
  if (model_is_layered_) {
    const Rgb& background = request.settings.scheme.background;
    image.rgb.assign(image.rgb.size(), {background.r, background.g, background.b});
    depth.assign(image.rgb.size(), std::numeric_limits<float>::infinity());
  }
  Compositor compositor(image, std::move(depth), scene_box_.diagonal());
  SolidRenderer::Sides sides;
  for (const auto& layer : layers_) {
    if (request.settings.stop.stop_requested()) break;
    const csgcore::FrameSettings of_layer = layer->frame(frame);
    renderer.draw_sides(layer->solid(), of_layer, request, layer->shows_behind(), sides);
    if (layer->shows_behind()) compositor.add(*layer, sides.behind, sides.area);
    compositor.add(*layer, sides.front, sides.area);
    for (const PreparedLayer::Part& part : layer->parts()) {
      renderer.draw_sides(part.solid, of_layer, request, part.is_subtracted, sides);
      compositor.add_part(*layer, part.is_subtracted ? sides.behind : sides.front, sides.area);
    }
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
