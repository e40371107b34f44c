// An OpenGL 3.3 core context without a window or a display.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "glrender/gl_error.hpp"

namespace glrender {

class ProgramCache;

/// Owns an EGL display and a surfaceless context, which is current on the thread that made it.
/// Everything else in glrender must be used on that thread, within the context's lifetime, unless
/// another one takes the context over. The constructor takes the first hardware device
/// (EGL_EXT_platform_device), else Mesa's surfaceless platform, which llvmpipe serves. It throws
/// GlError.
class HeadlessContext {
 public:
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;

  /// The driver's GL_RENDERER.
  const std::string& renderer_name() const;

  /// The most texels that the driver allows in a buffer that shaders read. Tests may feign a lesser
  /// driver, for the renderers that are made from then on.
  uint64_t most_texels() const;
  void set_most_texels(uint64_t most);

  /// Another thread takes the context over: this one leaves it, then that one takes it.
  void leave_thread();
  void take_thread();

  /// The shaders that were compiled so far: all renderers of the context share them.
  ProgramCache& programs();
  /// Whether missing ones are compiled, as they are at first, or ShaderMissing is thrown.
  void set_compiles(bool compiles);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glrender
