// What a renderer does for SceneRenderer: pictures of single solids. What the renderers share
// (colours, translucent parts, scale, the choice between them) is scene_renderer.cpp's.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"
#include "frontend/error.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/render_stats.hpp"
#include "render/layers.hpp"
#include "render/renderer_choice.hpp"

namespace frontend {

/// As a renderer takes it, each channel in [0, 1].
inline glm::vec3 color_of(const Rgb& color) {
  return glm::vec3(color.r, color.g, color.b) / 255.0f;
}

/// Sets the background to that of the scheme.
inline void set_background(const ColorScheme& scheme, csgcore::FrameSettings& frame) {
  frame.background = color_of(scheme.background);
  if (scheme.background_below) frame.background_below = color_of(*scheme.background_below);
}

/// Makes the picture, which has its size, one of the background alone.
inline void fill_background(const csgcore::FrameSettings& frame, csgcore::Image& image) {
  image.rgb.clear();
  for (uint32_t y = 0; y < image.height_px; ++y) {
    image.rgb.insert(image.rgb.end(), image.width_px,
                     csgcore::background_pixel(frame, y, image.height_px));
  }
}

/// Whether the settings ask for a kd-tree.
inline bool uses_cells(const RenderSettings& settings) {
  return settings.technique == Technique::kCells || settings.show == Show::kCells;
}

/// Of the model's picture: only a surface's is smoothed.
inline uint32_t samples_of(const RenderSettings& settings) {
  return settings.show == Show::kSurface ? settings.samples : 1;
}

/// One picture: from where, and how. `stats` is added to, but for `primitives`, `prepare_ms`,
/// `context_ms` and `reason`.
struct PictureRequest {
  const csgcore::View& view;
  const RenderSettings& settings;
  RenderStats& stats;
};

/// Draws one solid after another, and keeps what it makes of each (a kd-tree, what OpenGL holds)
/// for further pictures of it. The solids must live until forget().
class SolidRenderer {
 public:
  virtual ~SolidRenderer() = default;

  /// What settings.show asks for of the model: the surface, or the cells.
  virtual csgcore::Image draw_model(const csgcore::Solid& solid,
                                    const csgcore::FrameSettings& frame,
                                    const PictureRequest& request) = 0;

  /// The surface with one ray a pixel and the shadows that draws_shadows() asks for. `light_box`:
  /// of all that the picture shows.
  virtual csgcore::Image draw_shadowed_model(const csgcore::Solid& solid,
                                             const csgcore::FrameSettings& frame,
                                             const csgcore::Box& light_box,
                                             const PictureRequest& request);

  /// Whether draw_model_areas() can be asked for.
  virtual bool draws_areas() const { return false; }
  /// The surface of the model, within the areas alone: the rest of `image` stays.
  virtual void draw_model_areas(const csgcore::Solid&, const csgcore::FrameSettings&,
                                const PictureRequest&, std::span<const csgcore::PixelArea>,
                                csgcore::Image&) {}

  /// Blends layers over a picture, with one ray a pixel: at the edge of what is blended later, a
  /// colour mixed with the background's would show as a seam.
  virtual void draw_layers(const LayerSurfaces& layers, const PictureRequest& request,
                           Compositor& compositor) = 0;

  /// All solids that were drawn.
  virtual void forget() = 0;

  /// Whether it compiles shaders that it lacks, as at first, or throws ShaderMissing.
  virtual void set_compiles(bool) {}
  /// Another thread draws from now on: this one leaves, then that one takes the renderer over.
  virtual void leave_thread() {}
  virtual void take_thread() {}
};

/// Returns the drawing by the CPU tracer, csgcore/tracer.hpp.
std::unique_ptr<SolidRenderer> make_cpu_renderer();

/// Takes away the light that the solid hides from itself (draws_shadows()), by the CPU, in a
/// picture of one ray a pixel by either renderer. `light_box`: of all that the picture shows.
void draw_shadows(const csgcore::Solid& solid, const csgcore::Box& light_box,
                  const PictureRequest& request, csgcore::Image& image);

/// Thrown where OpenGL would have to compile a shader, and must not. The CPU may draw meanwhile.
struct ShaderMissing {};

/// OpenGL cannot be had, or failed. The CPU may still draw.
class GlFailure : public Error {
 public:
  explicit GlFailure(const std::string& reason, const std::string& todo = {})
      : Error({}, {}, reason, todo), reason_(reason) {}
  /// Without what to do, and without the word "error".
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Starts OpenGL. Throws GlFailure, as do the renderer's functions; also if the driver does not
/// meet the demands.
std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands& demands);

}  // namespace frontend
