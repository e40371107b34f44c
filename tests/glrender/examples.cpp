#include "examples.hpp"

#include <string>

#include "frontend/camera.hpp"
#include "frontend/files.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"

namespace gl_test {

frontend::ImportedDesign read_design(const std::filesystem::path& file) {
  const auto ignore_message = [](const std::string&) {};
  const frontend::FileText text =
      file.extension() == ".scad"
          ? frontend::export_with_openscad(file.string(), {}, false, ignore_message, [] {}).csg
          : frontend::read_file(file.string());
  return frontend::import_design(frontend::parse(text.view(), file.filename().string()),
                                 {.folder = file.parent_path().string()});
}

csgcore::View default_view(const frontend::ImportedDesign& design, uint32_t width_px,
                           uint32_t height_px) {
  frontend::CameraOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  return frontend::make_view(frontend::choose_camera(options, design.view_box), options);
}

}  // namespace gl_test
