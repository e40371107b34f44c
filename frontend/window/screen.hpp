// Puts an image into the window, by OpenGL.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"
#include "navigation.hpp"

namespace window {

/// Needs an OpenGL 3 context, current whenever it is used, and GL_FRAMEBUFFER 0 of the given size.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void load(const csgcore::Image& image);
  /// The image that was loaded last, stretched over the whole framebuffer.
  void draw(Size framebuffer) const;

 private:
  uint32_t texture_ = 0;
  uint32_t framebuffer_ = 0;
  Size size_;
};

}  // namespace window
