#include "render_target.hpp"

#include <limits>
#include <string>

#include "glrender/gl_error.hpp"
#include "shader_constants.hpp"

namespace glrender {
namespace {

/// Notes the pixel if it is marked. `mark` is in [0, 1], and may have been rounded to a byte.
void note(float mark, size_t pixel, Doubts& doubts) {
  if (mark == kMarkSure) return;
  doubts.pixels[pixel] = true;
  if (mark != kMarkDoubtful) doubts.has_unfinished = true;
}

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

RenderTarget::RenderTarget(const TargetFormat& format)
    : format_(format), framebuffer_(Framebuffer::make()) {
  const uint32_t width_px = format.width_px;
  const uint32_t height_px = format.height_px;
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width_px == 0 || height_px == 0 || width_px > static_cast<uint32_t>(limit) ||
      height_px > static_cast<uint32_t>(limit)) {
    throw GlError("this OpenGL driver draws pictures of 1 to " + std::to_string(limit) +
                  " pixels a side (choose another --imgsize)");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  const GLenum color_format = format.exact_colors ? GL_RGBA32F : GL_RGBA8;
  color_ = make_texture(color_format, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT0, width_px, height_px);
  if (format.measured) {
    measured_channels_ =
        make_texture(GL_RGBA32F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT1, width_px, height_px);
    id_ = make_texture(GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, GL_COLOR_ATTACHMENT2, width_px,
                       height_px);
  }
  depth_ = make_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_DEPTH_ATTACHMENT,
                        width_px, height_px);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  glDrawBuffers(format.measured ? 3 : 1, buffers);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw GlError("this OpenGL driver cannot draw into a picture of " + std::to_string(width_px) +
                  "×" + std::to_string(height_px) + " pixels (choose a smaller --imgsize)");
  }
}

/// A gradient is cleared row by row.
void RenderTarget::clear_color(const csgcore::FrameSettings& settings) const {
  const auto clear = [&](uint32_t y) {
    const glm::vec3 background = csgcore::background_of_row(settings, y, format_.height_px);
    const float color[] = {background.r, background.g, background.b, 1.0f};
    glClearBufferfv(GL_COLOR, 0, color);
  };
  if (!settings.background_below) return clear(0);
  glEnable(GL_SCISSOR_TEST);
  for (uint32_t y = 0; y < format_.height_px; ++y) {
    glScissor(0, static_cast<GLint>(format_.height_px - 1 - y),
              static_cast<GLsizei>(format_.width_px), 1);
    clear(y);
  }
  glDisable(GL_SCISSOR_TEST);
}

void RenderTarget::begin(const csgcore::FrameSettings& settings) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, static_cast<GLsizei>(format_.width_px), static_cast<GLsizei>(format_.height_px));
  const float none[] = {0, 0, 0, std::numeric_limits<float>::infinity()};
  const uint32_t no_id[] = {csgcore::kNoPrimitive, 0, 0, 0};
  const float furthest = 0;  // depth falls with distance
  glDepthMask(GL_TRUE);
  clear_color(settings);
  if (format_.measured) {
    glClearBufferfv(GL_COLOR, 1, none);
    glClearBufferuiv(GL_COLOR, 2, no_id);
  }
  glClearBufferfv(GL_DEPTH, 0, &furthest);
}

csgcore::Image RenderTarget::read(const Frame& frame, Doubts& doubts) const {
  csgcore::Image image;
  image.width_px = format_.width_px;
  image.height_px = format_.height_px;
  std::vector<uint8_t> rgba(pixels() * 4);
  read_pixels(GL_COLOR_ATTACHMENT0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  image.rgb.resize(pixels());
  doubts.pixels.resize(pixels());
  for (uint32_t y = 0; y < format_.height_px; ++y) {
    const uint8_t* row = rgba.data() + row_start(y) * 4;
    for (uint32_t x = 0; x < format_.width_px; ++x) {
      const size_t pixel = size_t{y} * format_.width_px + x;
      image.rgb[pixel] = {row[4 * x], row[4 * x + 1], row[4 * x + 2]};
      note(static_cast<float>(row[4 * x + 3]) / 255.0f, pixel, doubts);
    }
  }
  if (format_.measured) read_measured(frame, image);
  return image;
}

void RenderTarget::add_colors(std::vector<glm::vec3>& sum, Doubts& doubts) const {
  sum.resize(pixels(), glm::vec3(0.0f));
  doubts.pixels.resize(pixels());
  std::vector<glm::vec4> colors(pixels());
  read_pixels(GL_COLOR_ATTACHMENT0, GL_RGBA, GL_FLOAT, colors.data());
  for (uint32_t y = 0; y < format_.height_px; ++y) {
    const glm::vec4* row = colors.data() + row_start(y);
    const size_t first = size_t{y} * format_.width_px;
    for (uint32_t x = 0; x < format_.width_px; ++x) {
      sum[first + x] += glm::vec3(row[x]);
      note(row[x].w, first + x, doubts);
    }
  }
}

void RenderTarget::read_pixels(GLenum attachment, GLenum format, GLenum type, void* data) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(attachment);
  glReadPixels(0, 0, static_cast<GLsizei>(format_.width_px),
               static_cast<GLsizei>(format_.height_px), format, type, data);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    throw GlError("OpenGL reported error " + std::to_string(error) +
                  " while drawing (the driver may be out of memory: try a smaller --imgsize)");
  }
}

void RenderTarget::read_measured(const Frame& frame, csgcore::Image& image) const {
  std::vector<glm::vec4> measured(pixels());
  std::vector<uint32_t> ids(pixels());
  read_pixels(GL_COLOR_ATTACHMENT1, GL_RGBA, GL_FLOAT, measured.data());
  read_pixels(GL_COLOR_ATTACHMENT2, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  image.z.assign(pixels(), std::numeric_limits<float>::infinity());
  image.normal.assign(pixels(), glm::vec3(0.0f));
  image.position.assign(pixels(), glm::vec3(0.0f));
  image.id.assign(pixels(), csgcore::kNoPrimitive);
  for (uint32_t y = 0; y < format_.height_px; ++y) {
    const size_t row = row_start(y);
    for (uint32_t x = 0; x < format_.width_px; ++x) {
      const glm::vec4& sample = measured[row + x];
      if (sample.w == std::numeric_limits<float>::infinity()) continue;
      const size_t pixel = size_t{y} * format_.width_px + x;
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
