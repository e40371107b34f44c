#include "render/translucent_layer.hpp"

#include <cmath>

namespace frontend {
namespace {

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

const LayerColor& color_of(LayerKind kind) {
  return kind == LayerKind::kBackground ? kBackgroundColor : kHighlightColor;
}

}  // namespace

glm::vec3 layer_color(LayerKind kind) {
  const LayerColor& color = color_of(kind);
  return glm::vec3(color.r, color.g, color.b) / 255.0f;
}

std::shared_ptr<const csgcore::CanonicalPrimitives> layer_primitives(
    std::shared_ptr<const csgcore::CanonicalPrimitives> primitives, LayerKind kind) {
  if (kind == LayerKind::kBackground) return primitives;
  auto plain = std::make_shared<csgcore::CanonicalPrimitives>(*primitives);
  for (csgcore::CanonicalPrimitive& primitive : *plain) primitive.color.reset();
  return plain;
}

LayerOpacity::LayerOpacity(const csgcore::Solid& solid, LayerKind kind)
    : layer_(color_of(kind).a / 255.0f) {
  for (const csgcore::BlistTest& test : solid.list().tests) {
    const csgcore::CanonicalPrimitive& primitive = solid.primitives()[test.primitive];
    if (primitive.color) own_[primitive.id] = primitive.color->a;
  }
}

float LayerOpacity::of(uint32_t id) const {
  const auto own = own_.find(id);
  return own == own_.end() ? layer_ : own->second;
}

void blend_layer(const csgcore::Image& layer, const LayerOpacity& opacity, double scene_size,
                 csgcore::Image& image) {
  for (size_t pixel = 0; pixel < layer.rgb.size(); ++pixel) {
    // A miss of the layer is at infinity, and in front of nothing.
    if (std::isinf(layer.z[pixel])) continue;
    const double reach = (std::abs(layer.z[pixel]) + scene_size) * kSameDepth;
    if (layer.z[pixel] - reach > image.z[pixel]) continue;
    const float alpha = opacity.of(layer.id[pixel]);
    for (size_t channel = 0; channel < 3; ++channel) {
      const float below = image.rgb[pixel][channel];
      const float above = layer.rgb[pixel][channel];
      image.rgb[pixel][channel] =
          static_cast<uint8_t>(std::lround(below + alpha * (above - below)));
    }
  }
}

}  // namespace frontend
