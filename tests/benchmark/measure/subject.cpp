#include "subject.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include "../reference_check.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "designs.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace measure {

Subject make_subject(const std::string& name, const std::string& csg) {
  frontend::ImportedDesign design = frontend::import_design(frontend::parse(csg, name));
  return {name, std::make_shared<const csgcore::Scene>(std::move(design.scene)), design.view_box};
}

Subject read_subject(const std::string& design, const Settings& settings) {
  std::ifstream file(csg_of(design, settings));
  std::stringstream text;
  text << file.rdbuf();
  return make_subject(design, text.str());
}

frontend::CameraOptions camera_options(uint32_t width_px, uint32_t height_px) {
  frontend::CameraOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  return options;
}

frontend::Camera default_camera(const Subject& subject) {
  return frontend::choose_camera(frontend::CameraOptions{}, subject.view_box);
}

csgcore::View default_view(const Subject& subject, const frontend::CameraOptions& options) {
  return frontend::make_view(default_camera(subject), options);
}

void require_exact(const Subject& subject, const csgcore::View& view) {
  const csgcore::Solid solid(csgcore::canonical_primitives(*subject.scene), subject.scene->model);
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, csgcore::TraceOptions{}, hits, stats);
  if (!frame_benchmark::agrees_with_reference(*subject.scene, view, hits)) {
    throw WrongAnswer(subject.name + ": not what the reference sees");
  }
}

}  // namespace measure
