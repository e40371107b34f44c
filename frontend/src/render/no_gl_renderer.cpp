// In place of gl_renderer.cpp in builds without OpenGL.
#include "render/gl_renderer.hpp"

namespace frontend {

std::unique_ptr<SolidRenderer> make_gl_renderer(const GlDemands&) {
  throw GlFailure("this scadray has no OpenGL",
                  "give --renderer=cpu; or build scadray with SCADRAY_GLRENDER=ON where libepoxy "
                  "is installed (libepoxy-dev)");
}

}  // namespace frontend
