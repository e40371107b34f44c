// The framebuffer of a picture and its way back into an Image.
#pragma once

#include "csgcore/image.hpp"
#include "frame.hpp"
#include "gl_object.hpp"

namespace glrender {

class RenderTarget {
 public:
  /// Throws GlError if the driver cannot make pictures of this size.
  RenderTarget(uint32_t width_px, uint32_t height_px, bool measured);

  /// Binds it, sets the viewport and clears all channels.
  void begin(const glm::vec3& background) const;
  csgcore::Image read(const Frame& frame) const;

  /// The texture of normals and t; 0 without measured channels.
  GLuint measured_texture() const { return measured_channels_.name(); }

  bool fits(uint32_t width_px, uint32_t height_px, bool measured) const {
    return width_px == width_px_ && height_px == height_px_ && measured == measured_;
  }

 private:
  void read_measured(const Frame& frame, csgcore::Image& image) const;

  uint32_t width_px_, height_px_;
  bool measured_;
  Framebuffer framebuffer_;
  Texture color_, measured_channels_, id_, depth_;
};

}  // namespace glrender
