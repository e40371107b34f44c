// The layers of a picture: solids that are drawn one after another, translucent or not
// (frontend/OPENSCAD.md, "Translucency").
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/surfaces.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// The solids of layers' parts. Products of one sum have most of their parts in common.
class PartSolids {
 public:
  explicit PartSolids(const csgcore::CanonicalPrimitives& primitives) : primitives_(primitives) {}
  std::shared_ptr<const csgcore::Solid> solid_of(csgcore::Layer::Kind kind,
                                                 const csgcore::Layer::Part& part);

 private:
  const csgcore::CanonicalPrimitives& primitives_;
  std::map<std::vector<uint64_t>, std::shared_ptr<const csgcore::Solid>> made_;
};

/// A layer of a scene, made ready to be drawn.
class PreparedLayer {
 public:
  PreparedLayer(const csgcore::CanonicalPrimitives& primitives, const csgcore::Layer& layer,
                PartSolids& parts);

  const csgcore::Solid& solid() const { return solid_; }
  bool is_of_model() const { return kind_ == csgcore::Layer::Kind::kModel; }
  bool shows_behind() const { return shows_behind_; }
  bool is_opaque() const;
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
  std::shared_ptr<const csgcore::Solid> solid;  // the same one of equal parts
  bool is_subtracted;                           // the surface that counts is its far side
};

/// The surfaces of layers, and the order in which they are blended. By depth, all layers that are
/// not opaque have a far side, and none has parts: the turns only settle which of coincident opaque
/// surfaces shows.
struct LayerSurfaces {
  struct Turn {
    const PreparedLayer* layer;
    uint32_t number;  // of the layer, from 1 on
    bool is_part;
  };
  std::vector<csgcore::Surface> surfaces;
  std::vector<uint32_t> turns;  // indices of surfaces
  std::vector<Turn> blended;    // by turn
  bool has_parts = false;
  Translucency order;

  /// `frame` is the scene's.
  LayerSurfaces(const std::vector<const PreparedLayer*>& layers,
                const csgcore::FrameSettings& frame, Translucency order);
};

/// Blends the surfaces of layers over a picture. In the file's order: those of a layer itself where
/// no earlier one lies in front of them, and a part's where it coincides with what is seen, unless
/// that is of the part's layer. By depth: all that no opaque surface hides, from the furthest to
/// the nearest, whatever their turns.
class Compositor final : public csgcore::SurfaceSink {
 public:
  /// `depth` holds View's s of what each pixel of `image` shows, +inf where that is nothing, or
  /// nothing if no pixel shows anything. Of the image's channels only rgb changes. Surfaces
  /// coincide where they are nearer than a rounding error of a picture of a scene of this size
  /// (world units): the later one is then drawn.
  /// `shares_from` is that of RenderSettings; what a pixel of `image` shows is what its id channel
  /// has or, if there is none, the background.
  Compositor(csgcore::Image& image, std::span<const float> depth, double scene_size,
             const LayerSurfaces& surfaces, std::optional<uint32_t> shares_from);

  /// Blends the surface of a turn from its picture in the area, with z and id channels.
  void blend(uint32_t turn, const csgcore::Image& picture, const csgcore::PixelArea& area);
  /// Ends the picture, once all turns have been drawn.
  void finish();
  /// Returns Image::shares of the finished picture, made smaller by averaging squares of so many
  /// pixels a side, or nothing if none were asked for.
  std::optional<std::vector<csgcore::PixelShare>> shares(uint32_t side) const;

  bool wants(uint32_t turn, const csgcore::PixelArea& area, float nearest_z) const override;
  uint32_t wanted(uint32_t turn, const csgcore::PixelBlock& block, float nearest_z,
                  double (&furthest_z)[csgcore::PixelBlock::kPixels]) const override;
  uint32_t shown(uint32_t turn, const csgcore::PixelBlock& block,
                 const float (&z)[csgcore::PixelBlock::kPixels]) const override;
  void draw(uint32_t turn, const csgcore::PixelBlock& block,
            const csgcore::SurfacePixels& pixels) override;
  void end(const csgcore::PixelArea& area) override;

 private:
  using Turn = LayerSurfaces::Turn;
  static constexpr uint32_t kNoLayer = 0;
  /// What is known of a square of pixels. Until it is looked at again, depths are upper bounds, and
  /// its pixels may have any layers.
  struct Square {
    float furthest;       // of depth_
    float furthest_seen;  // the same without pixels that show nothing
    uint32_t layer;       // in last_layer_, of all pixels if has_one
    bool has_one;
    bool is_stale = false;
  };

  /// Two depths that differ by less than this share of depth and scene size are those of the same
  /// surface, drawn twice in float: some ulps of each. A `#` part's own faces in the model are
  /// overlaid, all of them.
  static constexpr double kSameDepth = 0x1p-20;
  /// A surface at z coincides with those that are no further away than this.
  double reach(double z) const { return (std::abs(z) + scene_size_) * kSameDepth; }

  /// A surface in a pixel that waits for all others of the pixel, by depth.
  struct Fragment {
    float z;
    float opacity;  // in (0, 1]
    std::array<uint8_t, 3> rgb;
    uint8_t pixel;  // in the square, from its top left
    uint32_t turn;
    uint32_t id;  // Primitive::id
  };

  /// The fragments of a square.
  struct Kept {
    std::vector<Fragment> fragments;
    size_t to_sort_at = kFewFragments;  // once there are so many, hidden ones are dropped
  };
  static constexpr size_t kFewFragments = 2048;

  bool has_share(uint32_t id) const { return shares_from_ && id >= *shares_from_; }
  void start_shares();
  void share(const PreparedLayer& layer, const csgcore::PixelBlock& block,
             const csgcore::SurfacePixels& pixels);
  void keep(uint32_t turn, const csgcore::PixelBlock& block, const csgcore::SurfacePixels& pixels);
  void drop_hidden(uint32_t x, uint32_t y);
  std::span<Fragment> seen(std::span<Fragment> fragments, float& nearest_opaque) const;
  void blend_square(uint32_t x, uint32_t y);
  void blend_pixel(std::span<Fragment> fragments, std::array<uint8_t, 3>& rgb) const;
  bool is_below(const Fragment& a, const Fragment& b) const;
  void mark_stale(const csgcore::PixelBlock& block);

  static void blend_row(const PreparedLayer& layer, uint32_t drawn,
                        const csgcore::SurfacePixels& pixels, uint32_t first,
                        std::array<uint8_t, 3>* row);
  size_t square_at(uint32_t x, uint32_t y) const;
  Square look_at_square(uint32_t x, uint32_t y) const;
  bool may_show(const Turn& turn, double nearest, uint32_t x, uint32_t y) const;

  csgcore::Image& image_;
  const double scene_size_;
  const LayerSurfaces& surfaces_;
  const std::vector<Turn>& turns_;
  const uint32_t squares_across_;
  // Threads that draw squares side by side share no row of a block: all rows are of whole squares.
  const uint32_t stride_px_;
  std::vector<float> depth_;          // of what was drawn last at each pixel; by depth, of the
                                      // nearest opaque surface
  std::vector<uint32_t> last_layer_;  // that is seen at each pixel; none if no part asks for it
  mutable std::vector<Square> squares_;
  std::vector<Kept> kept_;  // by square; none in the file's order
  const std::optional<uint32_t> shares_from_;
  // By square: shares so far. Their pixels are those in the square, from its top left.
  std::vector<std::vector<csgcore::PixelShare>> shares_;
};

}  // namespace frontend
