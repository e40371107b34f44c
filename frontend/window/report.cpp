#include "report.hpp"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "frontend/error.hpp"
#include "frontend/terminal.hpp"

namespace window {
namespace {

using nlohmann::json;

json array_of(const csgcore::Vec3& v) { return {v.x, v.y, v.z}; }

json camera_of(const Navigation& navigation) {
  const frontend::Camera& camera = navigation.camera();
  return {{"target", array_of(camera.target)},
          {"rotation_deg", array_of(camera.rotation_deg)},
          {"distance", camera.distance},
          {"orthographic", navigation.projection() == csgcore::Projection::kOrthographic}};
}

json edit_of(const csgcore::EditStats& edit) {
  return {{"primitives", edit.primitives},
          {"primitives_changed", edit.primitives_changed},
          {"cells_made", edit.cells_made},
          {"pixels", edit.pixels},
          {"pixels_traced", edit.pixels_traced}};
}

json step_of(const frontend::TrailStep& step) {
  return {{"what", step.what},
          {"file", step.place.file},
          {"line", step.place.line},
          {"column", step.place.column}};
}

json leaf_of(const frontend::LeafPlace& place, bool is_cut) {
  json leaf = step_of(place.step());
  leaf["is_cut"] = is_cut;
  for (const frontend::TrailStep& step : place.trail) leaf["trail"].push_back(step_of(step));
  return leaf;
}

json points_of(const State& state) {
  json points = json::array();
  for (const MeasuredPoint& point : state.points) {
    json one = leaf_of(point.place, point.is_cut);
    one["position"] = array_of(point.position);
    one["surface"] = words_of(point.surface);
    points.push_back(std::move(one));
  }
  return points;
}

json times_of(const State& state) {
  json times = json::object();
  if (const auto& painting = state.painting) {
    times["draw"] = painting->stats.traverse_ms + painting->stats.render_ms;
    times["light"] = painting->light_ms;
    times["prepare"] = painting->stats.prepare_ms;
    times["subdivide"] = painting->stats.subdivide_ms;
  }
  if (const auto& version = state.version) {
    times["export"] = version->export_ms;
    times["read"] = version->read_ms;
    times["parse"] = version->parse_ms;
    times["import"] = version->import_ms;
  }
  return times;
}

}  // namespace

Report::Report(const std::string& path) {
  if (path.empty()) return;
  file_.reset(path == "-" ? stdout : std::fopen(path.c_str(), "we"));
  if (!file_) {
    throw frontend::Error(path, {}, std::string("cannot be written: ") + std::strerror(errno),
                          "give --stats another file");
  }
}

void Report::write(const State& state, double save_to_screen_ms) {
  if (!file_) return;
  json line = {
      {"version", state.version ? state.version->number : 0},
      {"error", state.version ? state.version->error : ""},
      {"messages", state.version ? state.version->messages : std::vector<std::string>{}},
      {"primitives", state.design ? state.design->scene.primitives.size() : 0},
      {"camera", camera_of(state.navigation)},
      {"section_on", state.section.is_on},
      {"section_position", state.section.position},
      {"section_normal", array_of(state.section.normal)},
      {"points", points_of(state)},
      {"hovered", state.hovered ? leaf_of(state.hovered->place, state.hovered->is_cut) : json()},
      {"frames_per_second", state.frames_per_second},
      {"times_ms", times_of(state)},
      {"status", status_line(state)}};
  if (const auto& painting = state.painting) {
    line["renderer"] = painting->stats.renderer;
    line["edit"] = edit_of(painting->stats.edit);
    line["width_px"] = painting->order.size.width_px;
    line["height_px"] = painting->order.size.height_px;
  }
  if (save_to_screen_ms >= 0) line["save_to_screen_ms"] = save_to_screen_ms;
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
  frontend::print_text(file_.get(), text);
  std::fflush(file_.get());
}

}  // namespace window
