// What is thrown where OpenGL fails.
#pragma once

#include <stdexcept>

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

/// Thrown in place of compiling a shader, where that must not be (HeadlessContext::set_compiles).
class ShaderMissing : public GlError {
 public:
  ShaderMissing() : GlError("a shader is not compiled yet") {}
};

}  // namespace glrender
