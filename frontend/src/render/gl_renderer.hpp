// The drawing by OpenGL.
#pragma once

#include <memory>
#include <string>

#include "frontend/error.hpp"
#include "render/renderer_choice.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {

/// OpenGL cannot be had, or failed. The CPU may still draw.
class GlFailure : public Error {
 public:
  explicit GlFailure(const std::string& reason, const std::string& todo = {})
      : Error({}, {}, reason, todo), reason_(reason) {}
  /// Without what to do, and without the word "error".
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Starts OpenGL. Throws GlFailure, as do the renderer's functions; also if the driver does not
/// meet the demands.
std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands& demands);

}  // namespace frontend
