#include "render/prepared_scene.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "csgcore/changed_areas.hpp"

namespace frontend {

using csgcore::Image;

namespace {

/// The most pixels of a picture that is made smaller: they take 1.5 GB.
constexpr uint64_t kMostFinePixels = uint64_t{1} << 26;

Image blank(const csgcore::View& view) {
  Image image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  image.rgb.resize(size_t{image.width_px} * image.height_px);
  return image;
}

/// Returns the side of a square of at least as many rays a pixel as are asked for, or as memory
/// allows.
uint32_t rays_along_pixel(const PictureRequest& request) {
  const uint32_t samples = samples_of(request.settings);
  const uint64_t pixels = uint64_t{request.view.width_px} * request.view.height_px;
  uint32_t side = 1;
  while (side * side < samples && (side + 1) * (side + 1) * pixels <= kMostFinePixels) ++side;
  return side;
}

/// Returns the averages of squares of pixels, `side` on a side.
std::vector<std::array<uint8_t, 3>> averaged(const Image& fine, uint32_t side) {
  const uint32_t width = fine.width_px / side, height = fine.height_px / side;
  const uint32_t count = side * side;
  std::vector<std::array<uint8_t, 3>> result(size_t{width} * height);
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      std::array<uint32_t, 3> sum{};
      for (size_t row = y * side; row < (y + 1) * side; ++row) {
        for (size_t column = x * side; column < (x + 1) * side; ++column) {
          const auto& pixel = fine.rgb[row * fine.width_px + column];
          for (size_t channel = 0; channel < 3; ++channel) sum[channel] += pixel[channel];
        }
      }
      for (size_t channel = 0; channel < 3; ++channel) {
        result[y * width + x][channel] = static_cast<uint8_t>((sum[channel] + count / 2) / count);
      }
    }
  }
  return result;
}

}  // namespace

PreparedScene::PreparedScene(std::shared_ptr<const csgcore::Scene> scene)
    : scene_(std::move(scene)),
      primitives_(csgcore::canonical_primitives(*scene_)),
      model_(primitives_, scene_->model),
      scene_box_(model_.bounds()) {
  PartSolids parts(*primitives_);
  for (const csgcore::Layer& layer : scene_->layers) {
    layers_.push_back(std::make_unique<const PreparedLayer>(*primitives_, layer, parts));
    model_is_layered_ = model_is_layered_ || layers_.back()->is_of_model();
    scene_box_.merge(layers_.back()->solid().bounds());
  }
  eye_parts_.resize(1 + layers_.size());
}

bool PreparedScene::is_within(const csgcore::Solid& solid, const PictureRequest& request) const {
  // An orthographic eye sees from infinity.
  return request.view.projection == csgcore::Projection::kPerspective &&
         request.settings.show == Show::kSurface && !solid.bounds().empty() &&
         solid.contains(request.view.eye);
}

bool PreparedScene::is_within(const PictureRequest& request) const {
  return is_within(model_, request) ||
         std::any_of(layers_.begin(), layers_.end(),
                     [&](const auto& layer) { return is_within(layer->solid(), request); });
}

PreparedScene::Composition PreparedScene::composition(SolidRenderer& renderer,
                                                      const PictureRequest& request) const {
  Composition result{{}, model_is_layered_};
  const auto add_parts = [&](size_t index, const csgcore::Solid& solid, csgcore::Layer::Kind kind,
                             const csgcore::CsgTree& tree) {
    if (!is_within(solid, request)) return false;
    std::optional<EyeParts>& parts = eye_parts_[index];
    if (!parts) parts.emplace(*scene_, primitives_, kind, tree);
    const EyeParts::Layers& layers = parts->layers(request.view.eye, [&] { renderer.forget(); });
    for (const auto& layer : layers) result.layers.push_back(layer.get());
    return !layers.empty();
  };
  if (!model_is_layered_) {
    result.model_is_layered = add_parts(0, model_, csgcore::Layer::Kind::kModel, scene_->model);
  }
  for (size_t i = 0; i < layers_.size(); ++i) {
    const csgcore::Layer& layer = scene_->layers[i];
    const bool is_whole = layer.shows_behind || !layer.parts.empty() ||
                          !add_parts(1 + i, layers_[i]->solid(), layer.kind, layer.solid);
    if (is_whole) result.layers.push_back(layers_[i].get());
  }
  return result;
}

csgcore::FrameSettings PreparedScene::frame_settings(const RenderSettings& settings,
                                                     bool has_layers) const {
  csgcore::FrameSettings frame;
  set_background(settings.scheme, frame);
  frame.front = color_of(settings.scheme.front);
  frame.back = color_of(settings.scheme.back);
  if (settings.from_within) frame.from_within = color_of(*settings.from_within);
  frame.shading = settings.shading;
  frame.measured_channels = settings.measured_channels || settings.depth_and_id || has_layers;
  frame.depth_and_id_only = !settings.measured_channels;
  if (has_layers) frame.scene_box = scene_box_;
  return frame;
}

Image PreparedScene::draw(SolidRenderer& renderer, const PictureRequest& request) const {
  const Composition composition = this->composition(renderer, request);
  const csgcore::FrameSettings frame =
      frame_settings(request.settings, !composition.layers.empty());
  const bool has_shadows = draws_shadows(request.settings);
  // What layers are drawn over. Its measured channels are always the model's.
  const bool wants_model = !(composition.model_is_layered || has_shadows) ||
                           request.settings.measured_channels || request.settings.depth_and_id ||
                           request.settings.show == Show::kCells;
  Image image = wants_model ? renderer.draw_model(model_, frame, request) : blank(request.view);
  request.stats.edit.pixels = request.stats.edit.pixels_traced = image.rgb.size();
  if (request.settings.show == Show::kCells || (composition.layers.empty() && !has_shadows)) {
    return image;
  }
  const LayerSurfaces surfaces(composition.layers, frame, request.settings.translucency);
  if (!composition.model_is_layered && !has_shadows) {
    Compositor compositor(image, image.z, scene_box_.diagonal(), surfaces,
                          request.settings.shares_from);
    renderer.draw_layers(surfaces, request, compositor);
    compositor.finish();
    image.shares = compositor.shares(1);
    return image;
  }
  // Layers and shadows have one ray a pixel. So a smooth picture of them is one of more
  // pixels, made smaller.
  const uint32_t side = rays_along_pixel(request);
  csgcore::View view = request.view;
  view.width_px *= side;
  view.height_px *= side;
  RenderSettings settings = request.settings;
  settings.samples = 1;
  settings.studio.block_px = side;
  const PictureRequest of_fine{view, settings, request.stats};
  Image fine;
  if (composition.model_is_layered) {
    fine = blank(view);
    fill_background(frame, fine);
  } else {
    fine = renderer.draw_shadowed_model(model_, frame, scene_box_, of_fine);
  }
  if (!composition.layers.empty()) {
    Compositor compositor(fine, fine.z, scene_box_.diagonal(), surfaces,
                          request.settings.shares_from);
    renderer.draw_layers(surfaces, of_fine, compositor);
    compositor.finish();
    image.shares = compositor.shares(side);
  }
  if (has_shadows && composition.model_is_layered) draw_shadows(model_, scene_box_, of_fine, fine);
  image.rgb = side == 1 ? std::move(fine.rgb) : averaged(fine, side);
  return image;
}

void PreparedScene::redraw(SolidRenderer& renderer, const PictureRequest& request,
                           const PreparedScene& earlier, const csgcore::SceneEdit& edit,
                           Image& image) const {
  const bool has_layers = !layers_.empty() || !earlier.layers_.empty();
  if (has_layers || draws_shadows(request.settings) || is_within(request) ||
      earlier.is_within(request) || request.settings.show == Show::kCells ||
      !renderer.draws_areas()) {
    image = draw(renderer, request);
    return;
  }
  const csgcore::FrameSettings frame = frame_settings(request.settings, false);
  const std::vector<csgcore::PixelArea> areas =
      changed_areas(earlier.model_, model_, edit, edit.model, request.view, frame);
  renderer.draw_model_areas(model_, frame, request, areas, image);
  request.stats.edit.pixels = image.rgb.size();
  request.stats.edit.pixels_traced = csgcore::count_pixels(areas);
}

}  // namespace frontend
