// The trees of a scene, made ready once and drawn by any renderer.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/scene_edit.hpp"
#include "csgcore/solid.hpp"
#include "render/eye_parts.hpp"
#include "render/layers.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {

class PreparedScene {
 public:
  explicit PreparedScene(std::shared_ptr<const csgcore::Scene> scene);

  /// The scene's layers, over the model where none of them is a part of it.
  csgcore::Image draw(SolidRenderer& renderer, const PictureRequest& request) const;
  /// The same where `image` is the earlier scene's picture by the same request: only what the edit
  /// has changed is drawn, if the renderer can do that.
  void redraw(SolidRenderer& renderer, const PictureRequest& request, const PreparedScene& earlier,
              const csgcore::SceneEdit& edit, csgcore::Image& image) const;

  const csgcore::Scene& scene() const { return *scene_; }
  const csgcore::Solid& model() const { return model_; }

 private:
  /// What a picture is composed of.
  struct Composition {
    std::vector<const PreparedLayer*> layers;  // from the first that is drawn
    bool model_is_layered;
  };

  bool is_within(const csgcore::Solid& solid, const PictureRequest& request) const;
  /// Whether the eye lies in the model, or in a layer.
  bool is_within(const PictureRequest& request) const;
  Composition composition(SolidRenderer& renderer, const PictureRequest& request) const;
  csgcore::FrameSettings frame_settings(const RenderSettings& settings, bool has_layers) const;

  std::shared_ptr<const csgcore::Scene> scene_;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  csgcore::Solid model_;
  // From the first that is drawn. Renderers know solids by their addresses.
  std::vector<std::unique_ptr<const PreparedLayer>> layers_;
  bool model_is_layered_ = false;
  csgcore::Box scene_box_;  // of all
  /// What the last eye saw that lay in the model (the first), or in layers_.
  mutable std::vector<std::optional<EyeParts>> eye_parts_;
};

}  // namespace frontend
