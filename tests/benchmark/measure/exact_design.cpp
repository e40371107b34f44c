#include "exact_design.hpp"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "csgcore/solid.hpp"
#include "designs.hpp"
#include "frontend/camera.hpp"
#include "frontend/design_file.hpp"
#include "oracle/exact_rays.hpp"
#include "process.hpp"

namespace measure {
namespace {

using csgcore::Hits;
using csgcore::Scene;
using csgcore::View;
using frontend::RenderSettings;

constexpr double kMeshExportLimit_s = 600;

Hits trace(const Scene& scene, const View& view) {
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, {}, hits, stats);
  return hits;
}

Picture plain_picture(const Scene& scene, const View& view) {
  RenderSettings settings;
  settings.renderer = frontend::RendererKind::kCpu;
  return picture_of(draw(scene, view, settings));
}

ExactPictures exact_pictures(const Scene& scene, View view) {
  ExactPictures pictures{plain_picture(scene, view), {}};
  view.width_px *= kSupersampling;
  view.height_px *= kSupersampling;
  pictures.antialiased = averaged(plain_picture(scene, view), kSupersampling);
  return pictures;
}

std::string camera_argument(const frontend::Camera& camera) {
  char text[256];
  std::snprintf(text, sizeof text, "--camera=%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g",
                camera.target.x, camera.target.y, camera.target.z, camera.rotation_deg.x,
                camera.rotation_deg.y, camera.rotation_deg.z, camera.distance);
  return text;
}

}  // namespace

frontend::ImportedDesign read_csg(const std::filesystem::path& csg,
                                  const frontend::ImportOptions& options) {
  frontend::DesignFileOptions reading;
  reading.message = [](const std::string&) {};
  reading.progress = [](const char*) {};
  reading.import = options;
  frontend::DesignFile file = frontend::read_design(csg, reading);
  return frontend::import_design(file);
}

csgcore::Image draw(const Scene& scene, const View& view, const RenderSettings& settings) {
  frontend::RenderStats stats;
  return frontend::render(scene, view, settings, stats);
}

Picture picture_of(csgcore::Image image) {
  return {image.width_px, image.height_px, std::move(image.rgb)};
}

ExactDesign::ExactDesign(std::string design, const Settings& settings)
    : design_(std::move(design)), settings_(settings), csg_(csg_of(design_, settings)) {
  frontend::ImportedDesign imported = read_csg(csg_, {});
  scene_ = std::move(imported.scene);
  frontend::CameraOptions camera;
  camera.width_px = 640;
  camera.height_px = 480;
  const frontend::Camera chosen = frontend::choose_camera(camera, imported.view_box);
  view_ = frontend::make_view(chosen, camera);
  camera_arguments_ = {"--imgsize=640,480", camera_argument(chosen)};
  hold_against_oracle();
  pictures_ = exact_pictures(scene_, view_);
  frontend::ImportOptions rendered;
  rendered.picture = frontend::PictureKind::kRendered;
  rendered_ = exact_pictures(read_csg(csg_, rendered).scene, view_);
}

void ExactDesign::hold_against_oracle() {
  const oracle::ExactScene exact_scene(scene_);
  oracle::ExactRays rays(exact_scene);
  const std::vector<oracle::ExactHit> picture = oracle::exact_picture(exact_scene, view_);
  traced_ = trace(scene_, view_);
  size_ = exact_scene.size();
  exact_.width_px = view_.width_px;
  exact_.height_px = view_.height_px;
  uint64_t undecided = 0;
  double worst = 0;
  for (size_t i = 0; i < picture.size(); ++i) {
    const oracle::ExactHit& hit = picture[i];
    exact_.primitive.push_back(hit.primitive);
    exact_.s.push_back(0.5 * hit.s.lower + 0.5 * hit.s.upper);
    const double far = glm::length(traced_.position[i] - hit.position) / size_;
    const bool is_right = traced_.primitive[i] == hit.primitive &&
                          far <= oracle::kExactPositionError &&
                          glm::length(traced_.normal[i] - hit.normal) <= oracle::kExactNormalError;
    if (is_right) {
      worst = std::max(worst, far);
      continue;
    }
    const auto x = static_cast<double>(i % view_.width_px);
    const auto y = static_cast<double>(i / view_.width_px);
    if (rays.doubt(csgcore::pixel_ray(view_, x, y), view_.projection) == oracle::Doubt::kNone) {
      throw WrongAnswer(design_ + ": the CPU tracer at pixel " + std::to_string(i));
    }
    ++undecided;
  }
  check_ = {{"judge", "exact ray oracle"},
            {"pixels", picture.size()},
            {"undecided", undecided},
            {"position_worst", worst}};
}

const FacetedDesign& ExactDesign::faceted(uint32_t fragments) {
  const auto [entry, is_new] = faceted_.try_emplace(fragments);
  FacetedDesign& result = entry->second;
  if (!is_new) return result;
  const Source source = scad_of(design_, settings_);
  result.csg = file(".fn" + std::to_string(fragments) + ".csg");
  std::vector<std::string> command{"openscad", "-q", "-o", result.csg,
                                   "-D$fn=" + std::to_string(fragments)};
  command.insert(command.end(), source.defines.begin(), source.defines.end());
  command.push_back(source.file);
  const ProcessResult exported = run_process(command, {kMeshExportLimit_s});
  if (!exported.succeeded()) {
    faceted_.erase(entry);
    throw std::runtime_error(design_ + ": openscad: " + exported.output);
  }
  frontend::ImportOptions options;
  options.facets = frontend::Facets::kAll;
  result.scene = read_csg(result.csg, options).scene;
  result.hits = trace(result.scene, view_);
  result.plain = plain_picture(result.scene, view_);
  options.picture = frontend::PictureKind::kRendered;
  result.rendered = plain_picture(read_csg(result.csg, options).scene, view_);
  return result;
}

std::filesystem::path ExactDesign::file(const std::string& suffix) const {
  return settings_.work_folder / (design_ + suffix);
}

}  // namespace measure
