// The translucent `%` and `#` parts over a picture (frontend/OPENSCAD.md, "Light and colours").
#pragma once

#include <memory>
#include <unordered_map>

#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"

namespace frontend {

enum class LayerKind : uint8_t { kBackground, kHighlight };

/// The layer's own colour, each channel in [0, 1].
glm::vec3 layer_color(LayerKind kind);

/// The primitives with the colours that count in the layer: a color() replaces the colour of a `%`
/// part, not that of a `#` part.
std::shared_ptr<const csgcore::CanonicalPrimitives> layer_primitives(
    std::shared_ptr<const csgcore::CanonicalPrimitives> primitives, LayerKind kind);

/// How opaque each primitive of a layer is.
class LayerOpacity {
 public:
  LayerOpacity(const csgcore::Solid& solid, LayerKind kind);
  /// In [0, 1]; `id` is Primitive::id.
  float of(uint32_t id) const;

 private:
  float layer_;
  std::unordered_map<uint32_t, float> own_;
};

/// Blends the layer over `image` where it lies in front of what is drawn there, or on it: nearer
/// than a rounding error of a picture of a scene of this size (world units). Both pictures have z
/// and id channels; the image's measured channels stay those of the model.
void blend_layer(const csgcore::Image& layer, const LayerOpacity& opacity, double scene_size,
                 csgcore::Image& image);

}  // namespace frontend
