// The framebuffer of a picture, and its transfer into an Image.
#pragma once

#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "frame.hpp"
#include "gl_object.hpp"

namespace glrender {

struct TargetFormat {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  bool measured = false;      // with the measured channels
  bool exact_colors = false;  // colours in float, not rounded to 8 bits
  bool operator==(const TargetFormat&) const = default;
};

/// The pixels that the CPU should draw: the shaders have marked them (kMarkSure).
struct Doubts {
  std::vector<bool> pixels;
  bool has_unfinished = false;
};

class RenderTarget {
 public:
  /// Throws GlError if the driver cannot make pictures of this size.
  explicit RenderTarget(const TargetFormat& format);

  /// Binds the framebuffer, sets the viewport and clears all channels.
  void begin(const csgcore::FrameSettings& settings) const;
  /// Returns the picture, and adds its doubts. Their pixels are as many as the picture's, or are
  /// made so. Throws GlError if anything failed while drawing.
  csgcore::Image read(const Frame& frame, Doubts& doubts) const;
  /// Adds the colours, each in [0, 1], to the pixels of `sum`, in the order of an Image's. An empty
  /// `sum` starts from 0. Adds doubts and throws as read() does. Precondition: exact_colors.
  void add_colors(std::vector<glm::vec3>& sum, Doubts& doubts) const;

  /// The texture of normals and t; 0 without measured channels.
  GLuint measured_texture() const { return measured_channels_.name(); }

  const TargetFormat& format() const { return format_; }

 private:
  void clear_color(const csgcore::FrameSettings& settings) const;
  void read_measured(const Frame& frame, csgcore::Image& image) const;
  void read_pixels(GLenum attachment, GLenum format, GLenum type, void* data) const;
  size_t pixels() const { return size_t{format_.width_px} * format_.height_px; }
  /// Returns where the picture's row y starts in what OpenGL reads, whose rows run upwards.
  size_t row_start(uint32_t y) const {
    return size_t{format_.height_px - 1 - y} * format_.width_px;
  }

  TargetFormat format_;
  Framebuffer framebuffer_;
  Texture color_, measured_channels_, id_, depth_;
};

}  // namespace glrender
