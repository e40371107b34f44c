#include "render_target.hpp"

#include <limits>
#include <string>

#include "glrender/context.hpp"

namespace glrender {
namespace {

Texture make_texture(GLenum internal_format, GLenum format, GLenum type, GLenum attachment,
                     uint32_t width_px, uint32_t height_px) {
  Texture texture = Texture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format),
               static_cast<GLsizei>(width_px), static_cast<GLsizei>(height_px), 0, format, type,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
  return texture;
}

}  // namespace

RenderTarget::RenderTarget(uint32_t width_px, uint32_t height_px, bool measured)
    : width_px_(width_px),
      height_px_(height_px),
      measured_(measured),
      framebuffer_(Framebuffer::make()) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width_px == 0 || height_px == 0 || width_px > static_cast<uint32_t>(limit) ||
      height_px > static_cast<uint32_t>(limit)) {
    throw GlError("this OpenGL driver draws pictures of 1 to " + std::to_string(limit) +
                  " pixels a side (choose another --imgsize)");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  color_ =
      make_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_COLOR_ATTACHMENT0, width_px, height_px);
  if (measured) {
    measured_channels_ =
        make_texture(GL_RGBA32F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT1, width_px, height_px);
    id_ = make_texture(GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, GL_COLOR_ATTACHMENT2, width_px,
                       height_px);
  }
  depth_ = make_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_DEPTH_ATTACHMENT,
                        width_px, height_px);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  glDrawBuffers(measured ? 3 : 1, buffers);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw GlError("this OpenGL driver cannot draw into a picture of " + std::to_string(width_px) +
                  "×" + std::to_string(height_px) + " pixels (choose a smaller --imgsize)");
  }
}

void RenderTarget::begin(const glm::vec3& background) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, static_cast<GLsizei>(width_px_), static_cast<GLsizei>(height_px_));
  const float color[] = {background.r, background.g, background.b, 1.0f};
  const float none[] = {0, 0, 0, std::numeric_limits<float>::infinity()};
  const uint32_t no_id[] = {csgcore::kNoPrimitive, 0, 0, 0};
  const float furthest = 0;  // depth falls with distance
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, color);
  if (measured_) {
    glClearBufferfv(GL_COLOR, 1, none);
    glClearBufferuiv(GL_COLOR, 2, no_id);
  }
  glClearBufferfv(GL_DEPTH, 0, &furthest);
}

csgcore::Image RenderTarget::read(const Frame& frame) const {
  csgcore::Image image;
  image.width_px = width_px_;
  image.height_px = height_px_;
  const size_t pixels = size_t{width_px_} * height_px_;
  std::vector<uint8_t> rgba(pixels * 4);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, static_cast<GLsizei>(width_px_), static_cast<GLsizei>(height_px_), GL_RGBA,
               GL_UNSIGNED_BYTE, rgba.data());
  image.rgb.resize(pixels);
  for (uint32_t y = 0; y < height_px_; ++y) {
    // OpenGL's rows run upwards.
    const uint8_t* row = rgba.data() + size_t{height_px_ - 1 - y} * width_px_ * 4;
    for (uint32_t x = 0; x < width_px_; ++x) {
      image.rgb[size_t{y} * width_px_ + x] = {row[4 * x], row[4 * x + 1], row[4 * x + 2]};
    }
  }
  if (measured_) read_measured(frame, image);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    throw GlError("OpenGL reported error " + std::to_string(error) +
                  " while drawing (the driver may be out of memory: try a smaller --imgsize)");
  }
  return image;
}

void RenderTarget::read_measured(const Frame& frame, csgcore::Image& image) const {
  const size_t pixels = size_t{width_px_} * height_px_;
  std::vector<glm::vec4> measured(pixels);
  std::vector<uint32_t> ids(pixels);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, static_cast<GLsizei>(width_px_), static_cast<GLsizei>(height_px_), GL_RGBA,
               GL_FLOAT, measured.data());
  glReadBuffer(GL_COLOR_ATTACHMENT2);
  glReadPixels(0, 0, static_cast<GLsizei>(width_px_), static_cast<GLsizei>(height_px_),
               GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  image.z.assign(pixels, std::numeric_limits<float>::infinity());
  image.normal.assign(pixels, glm::vec3(0.0f));
  image.position.assign(pixels, glm::vec3(0.0f));
  image.id.assign(pixels, csgcore::kNoPrimitive);
  for (uint32_t y = 0; y < height_px_; ++y) {
    const size_t row = size_t{height_px_ - 1 - y} * width_px_;
    for (uint32_t x = 0; x < width_px_; ++x) {
      const glm::vec4& sample = measured[row + x];
      if (sample.w == std::numeric_limits<float>::infinity()) continue;
      const size_t pixel = size_t{y} * width_px_ + x;
      const double depth = frame.eye_distance + static_cast<double>(sample.w);
      const csgcore::Ray ray = csgcore::pixel_ray(frame.view, x, y);
      image.z[pixel] = static_cast<float>(depth);
      image.normal[pixel] = glm::vec3(sample);
      image.position[pixel] = glm::vec3(ray.origin + depth * ray.direction);
      image.id[pixel] = ids[row + x];
    }
  }
}

}  // namespace glrender
