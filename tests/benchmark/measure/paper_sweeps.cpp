#include "paper_sweeps.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "bench/report.hpp"
#include "cell_counts.hpp"
#include "designs.hpp"

namespace measure {
namespace {

using csgcore::Vec3;
using csgcore::View;
using nlohmann::json;

/// Returns `csg` in n places, `step` apart.
std::string copied(const std::string& csg, int n, const Vec3& step) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < n; ++i) {
    text << "multmatrix([";
    for (int row = 0; row < 3; ++row) {
      text << '[' << (row == 0) << ',' << (row == 1) << ',' << (row == 2) << ',' << i * step[row]
           << "],";
    }
    text << "[0,0,0,1]]) {\n" << csg << "}\n";
  }
  return text.str();
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

void PaperMeasurer::take_fewer_samples() {
  repetitions_.least = std::min<size_t>(repetitions_.least, 3);
  repetitions_.long_enough_ms /= 5;
}

json PaperMeasurer::rules(const Subject& subject, const View& view,
                          const std::vector<bench::Rule>& rules) {
  say("paper: " + subject.name);
  require_exact(subject, view);
  bench::Settings settings;
  settings.rules = rules;
  settings.frames = false;
  settings.threads = settings_.threads;
  settings.repetitions = repetitions_;
  const bench::Result result =
      bench::measure(subject.scene, std::span(&view, 1), settings, [](const std::string&) {});
  if (!result.wrong.empty()) throw WrongAnswer(subject.name + ": " + result.wrong[0]);
  if (left_out_.reasons.empty()) {
    for (const std::string& reason : result.left_out) left_out_.add("times by OpenGL", reason);
  }
  json all = json::array();
  for (const bench::RuleTimes& times : result.rules) {
    all.push_back(json(bench::json_of(times)));
    if (times.gl) opengl_ = times.gl->renderer;
  }
  return {{"design", subject.name},
          {"primitives", result.primitives},
          {"pixels", result.pixels},
          {"hits", result.hits},
          {"rules", all}};
}

json PaperMeasurer::point(const Subject& subject, const View& view) {
  json result = rules(subject, view, {bench::Rule{}});
  const CellCounts counts = count_cells(*subject.scene, view, bench::Rule{});
  return {{"hits", result["hits"]},
          {"cells", counts.cells},
          {"cells_in_view", counts.cells_in_view},
          {"cells_per_pixel", counts.cells_per_pixel},
          {"rule", result["rules"][0]}};
}

json growth_exponent(const json& points, size_t rule, const std::string& path) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const json& point : points) {
    const json::json_pointer place(path + "/median");
    const json& times = point["rules"][rule];
    if (!times.contains(place)) return nullptr;
    const double log_cones = std::log(point["cones"].get<double>());
    const double log_ms = std::log(times[place].get<double>());
    n += 1;
    x += log_cones;
    y += log_ms;
    xx += log_cones * log_cones;
    xy += log_cones * log_ms;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

json sweep_area(PaperMeasurer& measurer) {
  const Subject subject = read_subject("cs1000", measurer.settings());
  json points = json::array();
  for (const double distance : measurer.some<double>({1, 1.25, 1.6, 2, 2.8, 4, 5.6, 8})) {
    frontend::Camera camera = default_camera(subject);
    camera.distance *= distance;
    json point = measurer.point(subject, frontend::make_view(camera, camera_options()));
    point["distance"] = distance;
    points.push_back(std::move(point));
  }
  return {{"design", subject.name}, {"points", points}};
}

json sweep_cells_in_view(PaperMeasurer& measurer) {
  const Subject subject = read_subject("cs1000", measurer.settings());
  json points = json::array();
  for (const double pan : measurer.some<double>({0, 0.2, 0.35, 0.5, 0.65, 0.8})) {
    View view = default_view(subject, camera_options());
    const double width_at_target =
        2 * view.half_height * view.width_px / view.height_px * default_camera(subject).distance;
    view.eye += pan * width_at_target * view.right;
    json point = measurer.point(subject, view);
    point["pan"] = pan;
    points.push_back(std::move(point));
  }
  return {{"design", subject.name}, {"points", points}};
}

json sweep_depth(PaperMeasurer& measurer) {
  const std::string design = "cs100";
  const Subject one = read_subject(design, measurer.settings());
  frontend::CameraOptions options = camera_options();
  options.projection = csgcore::Projection::kOrthographic;
  const View view = default_view(one, options);
  const Vec3 step = 1.1 * one.view_box.diagonal() * view.forward;
  const std::string csg = read(csg_of(design, measurer.settings()));
  json points = json::array();
  for (const int copies : measurer.some<int>({1, 2, 4, 8, 16})) {
    const Subject subject =
        make_subject(design + " x " + std::to_string(copies), copied(csg, copies, step));
    json point = measurer.point(subject, view);
    point["copies"] = copies;
    points.push_back(std::move(point));
  }
  return {{"design", design}, {"points", points}};
}

}  // namespace measure
