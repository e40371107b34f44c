#include "screen.hpp"

#include <epoxy/gl.h>

namespace window {

Screen::Screen() {
  glGenTextures(1, &texture_);
  glGenFramebuffers(1, &framebuffer_);
}

Screen::~Screen() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void Screen::load(const csgcore::Image& image) {
  const Size size{image.width_px, image.height_px};
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (size == size_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(size.width_px),
                    static_cast<GLsizei>(size.height_px), GL_RGB, GL_UNSIGNED_BYTE,
                    image.rgb.data());
    return;
  }
  size_ = size;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(size.width_px),
               static_cast<GLsizei>(size.height_px), 0, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

void Screen::draw(Size framebuffer) const {
  if (size_.width_px == 0) return;
  const auto width = static_cast<GLint>(size_.width_px);
  const auto height = static_cast<GLint>(size_.height_px);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  // The first row of an image is the upper one, that of a framebuffer the lower one.
  glBlitFramebuffer(0, 0, width, height, 0, static_cast<GLint>(framebuffer.height_px),
                    static_cast<GLint>(framebuffer.width_px), 0, GL_COLOR_BUFFER_BIT,
                    framebuffer == size_ ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace window
