#include "examples.hpp"

#include "frontend/camera.hpp"
#include "support/read_design.hpp"

namespace gl_test {

frontend::ImportedDesign example(const std::string& name) {
  return test_support::read_design(std::string(SCADRAY_EXAMPLES_DIR "/") + name + ".scad");
}

csgcore::View default_view(const frontend::ImportedDesign& design, uint32_t width_px,
                           uint32_t height_px) {
  frontend::CameraOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  return frontend::make_view(frontend::choose_camera(options, design.view_box), options);
}

}  // namespace gl_test
