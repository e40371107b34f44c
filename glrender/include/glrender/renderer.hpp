// Draws a solid by OpenGL. A fragment shader traces the ray of the pixel, by either technique:
// - cells (paper §3): the front faces of a subdivision's leaf cells are rasterised, and the ray is
//   traced within the cell;
// - tiles: the CPU lists, for each frame, what the rays of some 8×8 pixels can meet
//   (csgcore/tile_lists.hpp), and each ray is traced along its whole length, once.
//
// Needs OpenGL 3.3 core. Uses more where the driver has it: ARB_conservative_depth and
// ARB_clip_control together let the driver skip fragments behind what is drawn already.
//
// GL state: works in framebuffers, textures, buffers and programs of its own; leaves depth test,
// depth clamp, face culling, front face, clip control and viewport as it set them.
#pragma once

#include <cstdint>
#include <memory>

#include "csgcore/image.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/view.hpp"
#include "glrender/context.hpp"
#include "glrender/frame_settings.hpp"

namespace glrender {

/// Renders one solid. The solid and the context must outlive it. Shader variants are compiled when
/// a cell first needs them.
class Renderer {
 public:
  Renderer(HeadlessContext& context, const csgcore::Solid& solid);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Uploads the cells' functions; again after Subdivision::refine. The subdivision must be of this
  /// renderer's solid and outlive its draws.
  void load(const csgcore::Subdivision& subdivision);

  /// Follows an edit, after Subdivision::update, whose result is `update`: the subdivision is the
  /// one that was loaded, and so is, from now on, the solid that it is of. Where primitives have
  /// kept their indices and cells were kept, uploads what is new of both; else all.
  /// Throws GlError.
  void update(const csgcore::Subdivision& subdivision, const csgcore::SceneEdit& edit,
              const csgcore::SubdivisionUpdate& update);

  /// The same with no cells, for tiles: `solid` is the one that is drawn from now on. Cells have to
  /// be loaded anew.
  void update(const csgcore::Solid& solid, const csgcore::SceneEdit& edit);

  /// Bytes of primitives and cells' functions that went to the GPU so far; what each frame sends
  /// besides, the cells in their order, is not counted.
  uint64_t uploaded_bytes() const;

  /// Draws what was loaded, from any view, in its front-to-back order (paper §2.3); by tiles,
  /// nothing need be loaded. Throws GlError; of tiles, ListsTooLong.
  csgcore::Image draw(const csgcore::View& view, const FrameSettings& settings, FrameStats& stats);

  /// What lies behind the last draw(), which must have had the same view and measured channels: the
  /// boundary at which each ray leaves the piece of the solid (or the gap, if the eye is inside)
  /// whose front draw() showed. For translucent parts.
  csgcore::Image draw_behind(const csgcore::View& view, const FrameSettings& settings,
                             FrameStats& stats);

  /// The paper's T_S (§4.1): traverses and passes the parameters with no pixel shader active.
  /// Returns ms.
  double traversal_ms(const csgcore::View& view);

  /// Paper §2.3: draws the cells in batches while another thread subdivides. The picture equals
  /// draw()'s with one sample, whatever settings.samples; afterwards nothing is loaded.
  /// stats.draw_ms is the paper's S_R.
  csgcore::Image draw_while_subdividing(const csgcore::SubdivisionOptions& options,
                                        const csgcore::View& view, const FrameSettings& settings,
                                        FrameStats& stats);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glrender
