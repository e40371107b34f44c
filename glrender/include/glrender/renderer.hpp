// Draws a solid by OpenGL. A fragment shader traces the ray of the pixel, by either technique:
// - cells (paper §3): the front faces of a subdivision's leaf cells are rasterised, and the ray is
//   traced within the cell;
// - tiles: the CPU lists, for each frame, what the rays of some 8×8 pixels can meet
//   (csgcore/tile_lists.hpp), and each ray is traced along its whole length, once.
//
// The renderer needs OpenGL 3.3 core. Where the driver has ARB_conservative_depth and
// ARB_clip_control, it uses both, so that the driver can skip fragments behind what is drawn
// already.
//
// GL state: the renderer works in framebuffers, textures, buffers and programs of its own. It
// leaves depth test, depth clamp, face culling, front face, clip control and viewport as it set
// them.
#pragma once

#include <cstdint>
#include <memory>

#include "csgcore/image.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/view.hpp"
#include "glrender/context.hpp"
#include "glrender/frame_settings.hpp"

namespace glrender {

/// Renders one solid. The solid and the context must outlive the renderer. A shader variant is
/// compiled when a cell or tile of the context's renderers first needs it.
class Renderer {
 public:
  Renderer(HeadlessContext& context, const csgcore::Solid& solid);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Uploads the Blists of the subdivision's cells. Must be called again after Subdivision::refine.
  /// The subdivision must be one of this renderer's solid, and outlive its draws.
  void load(const csgcore::Subdivision& subdivision);

  /// Draws the solid from any view. Cells must have been loaded, and are drawn front to back (paper
  /// §2.3); tiles need no load(). Throws GlError; by tiles also ListsTooLong.
  csgcore::Image draw(const csgcore::View& view, const FrameSettings& settings, FrameStats& stats);

  /// Draws what lies behind the last draw(), for translucent parts: the boundary at which each ray
  /// leaves the piece of the solid (or the gap, if the eye is inside) whose front draw() showed.
  /// Precondition: the last draw() had the same view, and measured channels.
  csgcore::Image draw_behind(const csgcore::View& view, const FrameSettings& settings,
                             FrameStats& stats);

  /// Returns the paper's T_S (§4.1) in ms: the time to traverse the tree and pass the parameters,
  /// with no pixel shader active.
  double traversal_ms(const csgcore::View& view);

  /// Draws the cells in batches while another thread subdivides (paper §2.3). The picture equals
  /// draw()'s with one sample, whatever settings.samples says. Afterwards no cells are loaded.
  /// stats.draw_ms is the paper's S_R.
  csgcore::Image draw_while_subdividing(const csgcore::SubdivisionOptions& options,
                                        const csgcore::View& view, const FrameSettings& settings,
                                        FrameStats& stats);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glrender
