// An OpenGL 3.3 core context without a window or a display.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

namespace glrender {

/// OpenGL is missing, too old, or failed; what() says what and what to do.
class GlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Tiles have lists that no shader can evaluate. Cells still may be drawn.
class ListsTooLong : public GlError {
 public:
  using GlError::GlError;
};

/// Owns an EGL display and a surfaceless context, current on the thread that made it; everything
/// else in glrender must be used on that thread, within the context's lifetime. Takes the first
/// hardware device (EGL_EXT_platform_device), else Mesa's surfaceless platform, which llvmpipe
/// serves. Throws GlError.
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;

  /// GL_RENDERER, as the driver says it.
  const std::string& renderer_name() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glrender
