// An OpenGL 3.3 core context without a window or a display.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace glrender {

/// Thrown where OpenGL is missing, too old, or fails; what() says which, and what to do.
class GlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown where a tile's list is too long for a shader. The same scene can still be drawn by cells.
class ListsTooLong : public GlError {
 public:
  using GlError::GlError;
};

/// Owns an EGL display and a surfaceless context, which is current on the thread that made it.
/// Everything else in glrender must be used on that thread, within the context's lifetime. The
/// constructor takes the first hardware device (EGL_EXT_platform_device), else Mesa's surfaceless
/// platform, which llvmpipe serves. It throws GlError.
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;

  /// The driver's GL_RENDERER.
  const std::string& renderer_name() const;

  /// The most texels of a buffer that shaders read, as the driver has it. Renderers that are made
  /// after limit_texels() take the driver for one that allows no more than that, so that tests can
  /// see what they do on a lesser driver.
  uint64_t most_texels() const;
  void limit_texels(uint64_t most);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glrender
