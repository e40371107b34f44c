// In place of gl_renderer.cpp in programs without OpenGL.
#include "frontend/render.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {

std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands&) {
  throw GlFailure("this scadray has no OpenGL", "give --renderer=cpu");
}

bool needs_gl_program(const RenderSettings& settings) {
  return settings.renderer == RendererKind::kGl ||
         (settings.renderer == RendererKind::kAuto && !why_no_gpu());
}

}  // namespace frontend
