// The layers of a picture: solids that are drawn one after another, translucent or not
// (frontend/OPENSCAD.md, "Translucency").
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {

/// A layer of a scene, made ready to be drawn.
class PreparedLayer {
 public:
  PreparedLayer(const csgcore::CanonicalPrimitives& primitives, const csgcore::Layer& layer);

  const csgcore::Solid& solid() const { return solid_; }
  bool is_of_model() const { return kind_ == csgcore::Layer::Kind::kModel; }
  bool shows_behind() const { return shows_behind_; }
  /// The operands whose surfaces count by themselves (csgcore::Layer::parts).
  struct Part;
  const std::vector<Part>& parts() const { return parts_; }
  /// The settings of the scene's frame with the layer's colours.
  csgcore::FrameSettings frame(csgcore::FrameSettings scene_frame) const;
  /// How opaque the surface of a primitive is, in [0, 1]; `id` is Primitive::id.
  float opacity(uint32_t id) const;

 private:
  csgcore::Layer::Kind kind_;
  bool shows_behind_;
  csgcore::Solid solid_;
  std::vector<Part> parts_;
  std::optional<float> opacity_;  // of all primitives; none: they differ
  std::unordered_map<uint32_t, float> own_opacity_;
};

struct PreparedLayer::Part {
  csgcore::Solid solid;
  bool is_subtracted;  // the surface that counts is its far side
};

/// Blends layers over a picture, each where no earlier one lies in front of it.
class Compositor {
 public:
  /// `depth` holds View's s of what each pixel of `image` shows, +inf where that is nothing. Of the
  /// image's channels only rgb changes. Surfaces coincide where they are nearer than a rounding
  /// error of a picture of a scene of this size (world units): the later one is then drawn.
  Compositor(csgcore::Image& image, std::vector<float> depth, double scene_size);

  /// `side` is the layer's picture in the area, with z and id channels.
  void add(const PreparedLayer& layer, const csgcore::Image& side, const csgcore::PixelArea& area);

  /// Blends a part of the layer that was added last where its surface coincides with what is seen,
  /// unless the layer itself is.
  void add_part(const PreparedLayer& layer, const csgcore::Image& side,
                const csgcore::PixelArea& area);

 private:
  template <typename Shows>
  void blend(const PreparedLayer& layer, const csgcore::Image& side, const csgcore::PixelArea& area,
             const Shows& shows);

  csgcore::Image& image_;
  double scene_size_;
  std::vector<float> depth_;                      // of what was drawn last at each pixel
  std::vector<const PreparedLayer*> last_layer_;  // that is seen at each pixel
};

}  // namespace frontend
