// In place of gl_renderer.cpp in programs without OpenGL.
#include "render/gl_renderer.hpp"

namespace frontend {

std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands&) {
  throw GlFailure("this scadray has no OpenGL", "give --renderer=cpu");
}

}  // namespace frontend
