// The trees of a scene, made ready once and drawn by any renderer.
#pragma once

#include <memory>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/scene_edit.hpp"
#include "csgcore/solid.hpp"
#include "render/solid_renderer.hpp"
#include "render/translucent_layer.hpp"

namespace frontend {

class PreparedScene {
 public:
  explicit PreparedScene(std::shared_ptr<const csgcore::Scene> scene);
  /// Of a scene that was edited: what holds of the earlier one is shared.
  PreparedScene(std::shared_ptr<const csgcore::Scene> scene, const PreparedScene& earlier,
                const csgcore::SceneEdit& edit);

  /// The model, and over it the translucent `%` and `#` parts.
  csgcore::Image draw(SolidRenderer& renderer, const PictureRequest& request) const;
  /// The same where `image` is the earlier scene's picture by the same request: only what the edit
  /// has changed is drawn, if the renderer can do that.
  void redraw(SolidRenderer& renderer, const PictureRequest& request, const PreparedScene& earlier,
              const csgcore::SceneEdit& edit, csgcore::Image& image) const;

  const csgcore::Scene& scene() const { return *scene_; }
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

  void add_layers();
  void add_layer(const csgcore::CsgTree& tree, LayerKind kind);
  csgcore::FrameSettings frame_settings(const RenderSettings& settings) const;

  std::shared_ptr<const csgcore::Scene> scene_;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  csgcore::Solid model_;
  std::vector<std::unique_ptr<Layer>> layers_;  // from the first that is drawn
  csgcore::Box scene_box_;                      // of all; empty without layers
};

}  // namespace frontend
