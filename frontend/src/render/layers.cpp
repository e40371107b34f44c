#include "render/layers.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace frontend {
namespace {

using csgcore::CanonicalPrimitive;
using csgcore::CanonicalPrimitives;
using csgcore::CsgTree;
using csgcore::Image;
using csgcore::Layer;

struct LayerColor {
  uint8_t r, g, b, a;
};

/// OpenSCAD's colours of `%` and `#` parts.
constexpr LayerColor kBackgroundColor{180, 180, 180, 128};
constexpr LayerColor kHighlightColor{255, 81, 81, 128};

/// Two depths that differ by less than this share of depth and scene size are those of the same
/// surface, drawn twice in float: some ulps of each. A `#` part's own faces in the model are
/// overlaid, all of them.
constexpr double kSameDepth = 0x1p-20;

const LayerColor& color_of(Layer::Kind kind) {
  return kind == Layer::Kind::kBackground ? kBackgroundColor : kHighlightColor;
}

/// Makes the solid of a tree, of the primitives alone that it names: most layers name few of a
/// design's. A part that is subtracted shows its cut faces.
csgcore::Solid solid_of(const CanonicalPrimitives& primitives, Layer::Kind kind,
                        const CsgTree& tree, bool is_subtracted = false) {
  auto named = std::make_shared<CanonicalPrimitives>();
  std::unordered_map<uint32_t, uint32_t> new_indices;
  const CsgTree renamed = csgcore::renamed(tree, [&](uint32_t index) {
    const auto next = static_cast<uint32_t>(named->size());
    const auto [entry, is_new] = new_indices.try_emplace(index, next);
    if (is_new) {
      CanonicalPrimitive& primitive = named->emplace_back(primitives[index]);
      // color() does not count in `#` parts.
      if (kind == Layer::Kind::kHighlight) primitive.color.reset();
      if (is_subtracted) primitive.cut_faces = csgcore::CutFaces::kAlways;
    }
    return entry->second;
  });
  return csgcore::Solid(std::move(named), renamed);
}

}  // namespace

PreparedLayer::PreparedLayer(const CanonicalPrimitives& primitives, const Layer& layer)
    : kind_(layer.kind),
      shows_behind_(layer.shows_behind),
      solid_(solid_of(primitives, layer.kind, layer.solid)) {
  for (const Layer::Part& part : layer.parts) {
    parts_.push_back(
        {solid_of(primitives, kind_, part.solid, part.is_subtracted), part.is_subtracted});
  }
  const float layer_opacity = is_of_model() ? 1.0f : color_of(kind_).a / 255.0f;
  for (const CanonicalPrimitive& primitive : solid_.primitives()) {
    own_opacity_[primitive.id] = primitive.color ? primitive.color->a : layer_opacity;
  }
  const bool is_uniform =
      std::all_of(own_opacity_.begin(), own_opacity_.end(),
                  [&](const auto& entry) { return entry.second == own_opacity_.begin()->second; });
  if (is_uniform && !own_opacity_.empty()) opacity_ = own_opacity_.begin()->second;
}

csgcore::FrameSettings PreparedLayer::frame(csgcore::FrameSettings scene_frame) const {
  scene_frame.depth_and_id_only = true;
  if (is_of_model()) return scene_frame;
  const LayerColor& color = color_of(kind_);
  scene_frame.front = scene_frame.back = glm::vec3(color.r, color.g, color.b) / 255.0f;
  return scene_frame;
}

float PreparedLayer::opacity(uint32_t id) const {
  return opacity_ ? *opacity_ : own_opacity_.at(id);
}

Compositor::Compositor(Image& image, std::vector<float> depth, double scene_size)
    : image_(image),
      scene_size_(scene_size),
      depth_(std::move(depth)),
      last_layer_(depth_.size(), nullptr) {}

template <typename Shows>
void Compositor::blend(const PreparedLayer& layer, const Image& side,
                       const csgcore::PixelArea& area, const Shows& shows) {
  for (uint32_t y = area.y; y < area.y + area.height; ++y) {
    const size_t row = size_t{y} * image_.width_px;
    for (size_t pixel = row + area.x; pixel < row + area.x + area.width; ++pixel) {
      // A miss is at infinity, and in front of nothing.
      if (std::isinf(side.z[pixel])) continue;
      const double reach = (std::abs(side.z[pixel]) + scene_size_) * kSameDepth;
      if (!shows(pixel, reach)) continue;
      const float alpha = layer.opacity(side.id[pixel]);
      for (size_t channel = 0; channel < 3; ++channel) {
        const float below = image_.rgb[pixel][channel];
        const float above = side.rgb[pixel][channel];
        image_.rgb[pixel][channel] = static_cast<uint8_t>(below + alpha * (above - below) + 0.5f);
      }
    }
  }
}

void Compositor::add(const PreparedLayer& layer, const Image& side,
                     const csgcore::PixelArea& area) {
  blend(layer, side, area, [&](size_t pixel, double reach) {
    if (side.z[pixel] - reach > depth_[pixel]) return false;
    depth_[pixel] = std::min(depth_[pixel], side.z[pixel]);
    last_layer_[pixel] = &layer;
    return true;
  });
}

void Compositor::add_part(const PreparedLayer& layer, const Image& side,
                          const csgcore::PixelArea& area) {
  blend(layer, side, area, [&](size_t pixel, double reach) {
    return last_layer_[pixel] != &layer && std::abs(side.z[pixel] - depth_[pixel]) <= reach;
  });
}

}  // namespace frontend
