#include "state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "framing.hpp"

namespace window {
namespace {

using csgcore::Projection;
using frontend::Shading;
using frontend::Show;

std::optional<StandardView> standard_view(Command command) {
  switch (command) {
    case Command::kTop:
      return StandardView::kTop;
    case Command::kBottom:
      return StandardView::kBottom;
    case Command::kLeft:
      return StandardView::kLeft;
    case Command::kRight:
      return StandardView::kRight;
    case Command::kFront:
      return StandardView::kFront;
    case Command::kBack:
      return StandardView::kBack;
    case Command::kDiagonal:
      return StandardView::kDiagonal;
    default:
      return std::nullopt;
  }
}

std::optional<Show> shown_by(Command command) {
  switch (command) {
    case Command::kSurface:
      return Show::kSurface;
    case Command::kCells:
      return Show::kCells;
    case Command::kDepth:
      return Show::kDepth;
    case Command::kNormals:
      return Show::kNormals;
    case Command::kId:
      return Show::kId;
    default:
      return std::nullopt;
  }
}

std::optional<uint8_t> section_axis(Command command) {
  switch (command) {
    case Command::kSectionX:
      return 0;
    case Command::kSectionY:
      return 1;
    case Command::kSectionZ:
      return 2;
    default:
      return std::nullopt;
  }
}

/// Returns the switch that a command toggles; null if there is none.
template <typename AnyState>
auto switch_of(AnyState& state, Command command) -> decltype(&state.shows_help) {
  switch (command) {
    case Command::kAxes:
      return &state.overlays.axes;
    case Command::kCrosshairs:
      return &state.overlays.crosshairs;
    case Command::kScales:
      return &state.overlays.scales;
    case Command::kEdges:
      return &state.overlays.edges;
    case Command::kGrid:
      return &state.overlays.grid;
    case Command::kOrientation:
      return &state.shows_orientation;
    case Command::kMessages:
      return &state.shows_messages;
    case Command::kPlace:
      return &state.shows_place;
    case Command::kStatus:
      return &state.shows_status;
    case Command::kHelp:
      return &state.shows_help;
    case Command::kParameters:
      return &state.shows_parameters;
    case Command::kAnimation:
      return &state.shows_animation;
    default:
      return nullptr;
  }
}

/// Three points lie on a line if the sine of their angle is no more than this.
constexpr double kLeastSine = 1e-6;
constexpr double kKeyZoom = 1;  // in notches of the wheel

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace

std::string hover_text(const HoveredLeaf& hovered) {
  const std::vector<frontend::TrailStep>& trail = hovered.place.trail;
  const std::size_t leaf = hovered.place.leaf;
  std::string text = (hovered.is_cut ? "cut: " : "") + trail[leaf].what;
  if (trail[leaf].place.line > 0) text += '\n' + frontend::text_of(trail[leaf].place);
  if (leaf + 1 < trail.size()) text += "\nin " + trail[leaf + 1].what;
  return text;
}

State::State(const frontend::Options& options)
    : navigation(options.camera.camera.value_or(frontend::Camera{}), options.camera.projection),
      look(options.render),
      overlays(options.overlays),
      customizer(options.input, options.openscad_arguments),
      language(options.import.language),
      name(options.input) {
  overlays.edge_color = frontend::EdgeColor::kContrast;
  if (!options.given.view) overlays.grid = true;
}

void State::begin(const frontend::Options& options) {
  State fresh(options);
  fresh.navigation.set_projection(navigation.projection());
  fresh.look = look;
  fresh.overlays = overlays;
  fresh.language = language;
  fresh.shows_place = shows_place;
  fresh.shows_messages = shows_messages;
  fresh.shows_status = shows_status;
  fresh.shows_orientation = shows_orientation;
  fresh.shows_help = shows_help;
  fresh.shows_parameters = shows_parameters;
  fresh.recent_designs = std::move(recent_designs);
  fresh.exporting = std::move(exporting);
  *this = std::move(fresh);
}

void State::take(frontend::DesignVersion newest) {
  if (newest.design) {
    if (design != newest.design) {
      points.clear();
      last_points.clear();
    }
    design = newest.design;
  }
  messages = messages_of(newest);
  notice.clear();
  is_stopped = false;
  customizer.take(newest.parameters);
  version = std::move(newest);
}

/// Proposes a path with the suffix of what the design is, unless there is one already. A mesh or a
/// drawing that is shown is not to be replaced by what it is exported to.
void State::ask_for_model() {
  model_dialogue.is_asked_for = true;
  if (!model_dialogue.path.empty()) return;
  const bool is_plane_figure = design && design->is_plane_figure;
  const std::filesystem::path input = name == "-" ? "design" : name;
  for (const char* const suffix :
       is_plane_figure ? std::array{".svg", ".dxf"} : std::array{".stl", ".3mf"}) {
    model_dialogue.path = std::filesystem::path(input).replace_extension(suffix).string();
    if (model_dialogue.path != name) return;
  }
}

void State::measure(MeasuredPoint point) {
  if (points.size() == 2) points.clear();
  if (last_points.size() == 3) last_points.erase(last_points.begin());
  last_points.push_back(point.position);
  chosen_step = point.place.leaf;
  points.push_back(std::move(point));
}

const frontend::SourcePlace* State::place_to_open() const {
  if (!points.empty() && chosen_step < points.back().place.trail.size()) {
    return &points.back().place.trail[chosen_step].place;
  }
  return hovered ? &hovered->place.step().place : nullptr;
}

csgcore::Box State::bounds() const {
  if (!design) return {};
  if (bounds_.first != design) bounds_ = {design, seen_box(design->scene)};
  return bounds_.second;
}

void State::view_all() {
  if (design) navigation = window::view_all(navigation, *design, bounds(), section, free_part);
}

csgcore::Vec3 State::section_middle() const {
  const csgcore::Vec3 center = bounds().center();
  return center + (section.position - glm::dot(center, section.normal)) * section.normal;
}

void State::set_section(const csgcore::Vec3& normal, const csgcore::Vec3& point) {
  section.is_on = true;
  section.normal = normal;
  section.position = glm::dot(point, normal);
  section.is_flipped = glm::dot(navigation.view({1, 1}).forward, normal) > 0;
}

void State::set_section_normal(const csgcore::Vec3& normal) {
  const csgcore::Box box = bounds();
  set_section(normal, box.empty() ? csgcore::Vec3(0.0) : box.center());
}

void State::move_section(double share) {
  const csgcore::Box box = bounds();
  if (!section.is_on || box.empty()) return;
  const auto [low, high] = positions_in(box, section.normal);
  section.position = std::clamp(section.position + share * (high - low), low, high);
}

void State::turn_section(double about_x_deg, double about_y_deg) {
  if (!section.is_on || bounds().empty()) return;
  const csgcore::Vec3 middle = section_middle();
  const csgcore::View view = navigation.view({1, 1});
  const auto turned = [](const csgcore::Vec3& v, const csgcore::Vec3& axis, double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180;
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
  };
  section.normal =
      glm::normalize(turned(turned(section.normal, view.right, about_x_deg), view.up, about_y_deg));
  section.position = glm::dot(middle, section.normal);
}

/// Cuts parallel to the flat face that was measured last.
void State::cut_along_face() {
  if (points.empty() || points.back().surface.kind != Surface::Kind::kPlane) {
    notice = "click on a flat face first: the section plane is laid along it";
    return;
  }
  set_section_normal(points.back().surface.direction);
}

void State::cut_through_points() {
  if (last_points.size() < 3) {
    notice = "click on three points first: the section plane is laid through them";
    return;
  }
  const csgcore::Vec3 a = last_points[1] - last_points[0], b = last_points[2] - last_points[0];
  const csgcore::Vec3 across = glm::cross(a, b);
  if (!(glm::length(across) > kLeastSine * glm::length(a) * glm::length(b))) {
    notice = "the three points lie on a line: they give no section plane";
    return;
  }
  set_section(glm::normalize(across), last_points[0]);
}

bool State::apply(Command command) {
  if (const auto view = standard_view(command)) {
    navigation.look_from(*view);
  } else if (const auto show = shown_by(command)) {
    look.show = *show;
  } else if (const auto axis = section_axis(command)) {
    set_section_normal(axis_of(*axis));
  } else if (bool* const turned = switch_of(*this, command)) {
    *turned = !*turned;
    if (shows_parameters && command == Command::kParameters && customizer.parameters().empty()) {
      notice = "the design has no parameters";
    }
  } else {
    switch (command) {
      case Command::kViewAll:
        view_all();
        break;
      case Command::kCenter:
        navigation.look_at(csgcore::Vec3(0.0));
        break;
      case Command::kZoomIn:
        navigation.zoom(kKeyZoom);
        break;
      case Command::kZoomOut:
        navigation.zoom(-kKeyZoom);
        break;
      case Command::kPerspective:
        navigation.set_projection(Projection::kPerspective);
        break;
      case Command::kOrthographic:
        navigation.set_projection(Projection::kOrthographic);
        break;
      case Command::kOpenScadShading:
        look.shading = Shading::kOpenScad;
        break;
      case Command::kPhongShading:
        look.shading = Shading::kPhong;
        break;
      case Command::kStudioShading:
        look.shading = Shading::kStudio;
        break;
      case Command::kPhongShadows:
        look.phong_shadows = look.phong_shadows > 0 ? 0 : 1;
        break;
      case Command::kDepthOrder:
        look.translucency = look.translucency == frontend::Translucency::kDepth
                                ? frontend::Translucency::kFile
                                : frontend::Translucency::kDepth;
        break;
      case Command::kLanguage2021:
        language = language::LanguageVersion::k2021;
        break;
      case Command::kLanguage2026:
        language = language::LanguageVersion::k2026;
        break;
      case Command::kSection:
        if (section.is_on) {
          section.is_on = false;
        } else {
          set_section_normal(section.normal);
        }
        break;
      case Command::kSectionFace:
        cut_along_face();
        break;
      case Command::kSectionPoints:
        cut_through_points();
        break;
      case Command::kSectionFlip:
        section.is_flipped = !section.is_flipped;
        break;
      case Command::kForgetPoints:
        points.clear();
        last_points.clear();
        shows_help = false;
        break;
      case Command::kPlay:
        shows_animation = true;
        if (animation.is_playing()) {
          animation.pause();
        } else {
          animation.play(Animation::Clock::now());
        }
        break;
      case Command::kOpenDesign:
        asks_for_design = true;
        break;
      case Command::kSavePicture:
        picture_dialogue.is_asked_for = true;
        break;
      case Command::kExport:
        if (exporting.empty()) {
          ask_for_model();
        } else {
          notice = exporting + " is being exported (wait, or stop it by Esc)";
        }
        break;
      default:
        return false;
    }
  }
  return true;
}

bool State::is_checked(Command command) const {
  if (const auto show = shown_by(command)) return look.show == *show;
  if (const auto axis = section_axis(command)) return section.is_on && section.axis() == *axis;
  if (const bool* const turned = switch_of(*this, command)) return *turned;
  switch (command) {
    case Command::kPerspective:
      return navigation.projection() == Projection::kPerspective;
    case Command::kOrthographic:
      return navigation.projection() == Projection::kOrthographic;
    case Command::kOpenScadShading:
      return look.shading == Shading::kOpenScad;
    case Command::kPhongShading:
      return look.shading == Shading::kPhong;
    case Command::kStudioShading:
      return look.shading == Shading::kStudio;
    case Command::kPhongShadows:
      return look.phong_shadows > 0;
    case Command::kDepthOrder:
      return look.translucency == frontend::Translucency::kDepth;
    case Command::kLanguage2021:
      return language == language::LanguageVersion::k2021;
    case Command::kLanguage2026:
      return language == language::LanguageVersion::k2026;
    case Command::kSection:
      return section.is_on;
    case Command::kSectionFlip:
      return section.is_flipped;
    case Command::kPlay:
      return animation.is_playing();
    default:
      return false;
  }
}

namespace {

/// A part of the status line. If there is no room, the parts with the highest rank are left out
/// first.
struct StatusPart {
  std::string words;
  int rank;
  bool is_time = false;  // time of a stage; such parts are consecutive
};

/// The most characters of a driver's name, which may be as long as all the rest.
constexpr size_t kShortName = 12;

std::string size_words(const frontend::ImportedDesign& design) {
  const std::size_t primitives = design.scene.primitives.size();
  if (primitives == 0 && design.left_out == 0) return "the design is empty";
  return std::to_string(primitives) + (primitives == 1 ? " primitive" : " primitives");
}

std::vector<StatusPart> status_parts(const State& state) {
  constexpr const char* kStopped = "stopped; a save, or F5, starts again";
  std::vector<StatusPart> parts;
  if (!state.exporting.empty()) parts.push_back({"exporting " + state.exporting, 0});
  if (!state.version) {
    parts.push_back({state.is_stopped ? kStopped : "reading " + state.name, 0});
    return parts;
  }
  const frontend::DesignVersion& version = *state.version;
  if (state.design) parts.push_back({size_words(*state.design), 0});
  const auto time = [&parts](const char* format, double ms, int rank) {
    parts.push_back({text(format, ms), rank, true});
  };
  if (version.export_ms > 0) time("evaluate %.0f", version.export_ms, 3);
  time("parse %.1f", version.parse_ms, 9);
  time("import %.1f", version.import_ms, 8);
  if (state.painting) {
    const frontend::RenderStats& stats = state.painting->stats;
    if (stats.prepare_ms > 0) time("prepare %.1f", stats.prepare_ms, 7);
    if (stats.subdivide_ms > 0) time("subdivide %.1f", stats.subdivide_ms, 6);
    time("draw %.1f ms", stats.traverse_ms + stats.render_ms, 1);
    if (state.painting->light_ms > 0) time("light %.0f ms", state.painting->light_ms, 4);
  }
  if (state.frames_per_second > 0) {
    parts.push_back({text("%.0f frames/s", state.frames_per_second), 2});
  }
  if (state.painting) {
    const std::string& renderer = state.painting->stats.renderer;
    parts.push_back({renderer, renderer.size() <= kShortName ? 5 : 10});
    parts.push_back({std::to_string(state.painting->order.size.width_px) + " x " +
                         std::to_string(state.painting->order.size.height_px),
                     4});
  }
  if (state.is_reading) parts.push_back({"reading", 0});
  if (state.is_stopped) parts.push_back({kStopped, 0});
  return parts;
}

std::string joined(const std::vector<StatusPart>& parts) {
  std::string line;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) line += parts[i - 1].is_time && parts[i].is_time ? ", " : "  |  ";
    line += parts[i].words;
  }
  return line;
}

}  // namespace

std::string status_line(const State& state, const std::function<bool(const std::string&)>& fits) {
  std::vector<StatusPart> parts = status_parts(state);
  std::string line = joined(parts);
  while (!fits(line)) {
    const auto highest =
        std::max_element(parts.begin(), parts.end(),
                         [](const StatusPart& a, const StatusPart& b) { return a.rank < b.rank; });
    if (highest->rank == 0) break;
    parts.erase(highest);
    line = joined(parts);
  }
  return line;
}

std::string status_line(const State& state) {
  return status_line(state, [](const std::string&) { return true; });
}

}  // namespace window
