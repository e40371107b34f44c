// Puts an image into the window by OpenGL.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"
#include "navigation.hpp"

namespace window {

/// Precondition of every member: an OpenGL 3 context is current.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void load(const csgcore::Image& image);
  /// Draws the image that was loaded last, stretched over the whole default framebuffer, whose size
  /// is `framebuffer`.
  void draw(Size framebuffer) const;

 private:
  uint32_t texture_ = 0;
  uint32_t framebuffer_ = 0;
  Size size_;
};

}  // namespace window
