// In place of gl_renderer.cpp where scadray is built without OpenGL.
#include "render/gl_renderer.hpp"

namespace frontend {

std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands&) {
  throw GlFailure("this scadray was built without OpenGL", "give --renderer=cpu");
}

}  // namespace frontend
