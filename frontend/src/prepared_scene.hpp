// The trees of a scene, made ready once and drawn by any renderer.
#pragma once

#include <memory>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"
#include "solid_renderer.hpp"
#include "translucent_layer.hpp"

namespace frontend {

/// Keeps nothing of the scene that it is made from.
class PreparedScene {
 public:
  explicit PreparedScene(const csgcore::Scene& scene);

  /// The model, and over it the translucent `%` and `#` parts.
  csgcore::Image draw(SolidRenderer& renderer, const PictureRequest& request) const;

  size_t primitive_count() const { return primitives_->size(); }
  const csgcore::Solid& model() const { return model_; }

 private:
  struct Layer {
    Layer(const std::shared_ptr<const csgcore::CanonicalPrimitives>& primitives,
          const csgcore::CsgTree& tree, LayerKind layer_kind)
        : kind(layer_kind), solid(layer_primitives(primitives, kind), tree), opacity(solid, kind) {}
    LayerKind kind;
    csgcore::Solid solid;
    LayerOpacity opacity;
  };

  void add_layer(const csgcore::CsgTree& tree, LayerKind kind);
  csgcore::FrameSettings frame_settings(const RenderSettings& settings) const;

  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  csgcore::Solid model_;
  std::vector<std::unique_ptr<Layer>> layers_;  // from the first that is drawn
  csgcore::Box scene_box_;                      // of all; empty without layers
};

}  // namespace frontend
