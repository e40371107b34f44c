#include "preview_messages.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "messages/messages.hpp"
#include "preview_light.hpp"
#include "statements.hpp"

namespace serve {
namespace {

using csgcore::Vec3;
using language::MessageGroup;
using window::Customizer;
using window::Surface;

constexpr double kFieldOfView_deg = 22.5;  // of every picture
constexpr double kMostSide_px = 4096;
/// Farther numbers are no places of a design.
constexpr double kFar = 1e12;
/// A unit vector of a client may be rounded.
constexpr double kLengthError = 1e-6;

double finite(const Json& json, const std::string& what) {
  const double number = json.is_number() ? json.get<double>() : std::nan("");
  if (!(std::abs(number) <= kFar)) throw invalid("\"" + what + "\" is no number of a design");
  return number;
}

bool flag_of(const Json& json, const char* name) {
  const Json& flag = member_of(json, name);
  if (!flag.is_boolean()) throw invalid("\"" + std::string(name) + "\" is neither true nor false");
  return flag;
}

Vec3 vector_of(const Json& json, const char* name) {
  const Json& list = member_of(json, name);
  if (!list.is_array() || list.size() != 3)
    throw invalid("\"" + std::string(name) + "\" is no list of three numbers");
  return {finite(list[0], name), finite(list[1], name), finite(list[2], name)};
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

window::SectionPlane section_of(const Json& json) {
  window::SectionPlane section;
  if (json.is_null()) return section;
  section.is_on = true;
  const Vec3 normal = vector_of(json, "normal");
  const double length = glm::length(normal);
  if (!(std::abs(length - 1) < kLengthError)) throw invalid("\"normal\" has not the length 1");
  section.normal = normal / length;
  section.position = finite(member_of(json, "position"), "position");
  section.is_flipped = flag_of(json, "flipped");
  return section;
}

uint32_t side_of(const Json& json, const char* name) {
  return static_cast<uint32_t>(std::lround(number_of(json, name, 1, kMostSide_px)));
}

// Parameters.

Json json_of(const Customizer::Value& value) {
  return std::visit(
      [](const auto& known) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(known)>, language::LiteralText>)
          return known.text;
        else
          return known;
      },
      value);
}

const char* kind_of(const Customizer::Value& value) {
  constexpr const char* kKinds[] = {"boolean", "number", "text", "vector", ""};
  return kKinds[value.index()];
}

/// Returns the JSON as a value of the parameter's type, and within its limits.
Customizer::Value value_of(const Json& json, const Customizer::Parameter& parameter) {
  const auto fail = [&](const std::string& why) { return invalid(parameter.name + ": " + why); };
  const auto number = [&](const Json& one) {
    const double known = finite(one, parameter.name);
    const auto& range = parameter.range;
    if (range && (known < range->min || known > range->max)) throw fail("out of its range");
    return known;
  };
  Customizer::Value value;
  if (std::holds_alternative<bool>(parameter.value)) {
    if (!json.is_boolean()) throw fail("neither true nor false");
    value = json.get<bool>();
  } else if (std::holds_alternative<double>(parameter.value)) {
    value = number(json);
  } else if (std::holds_alternative<std::string>(parameter.value)) {
    if (!json.is_string()) throw fail("no text");
    value = json.get<std::string>();
    const Text text(json.get<std::string>());
    if (parameter.longest && text.size() > *parameter.longest * 4) throw fail("too long");
  } else {
    const auto* list = std::get_if<std::vector<double>>(&parameter.value);
    if (!list || !json.is_array() || json.size() != list->size())
      throw fail("no list of as many numbers");
    std::vector<double> numbers;
    for (const Json& one : json) numbers.push_back(number(one));
    value = std::move(numbers);
  }
  const auto is_value = [&](const auto& choice) { return choice.value == value; };
  if (!parameter.choices.empty() && std::ranges::none_of(parameter.choices, is_value))
    throw fail("none of its choices");
  return value;
}

Json json_of(const Customizer& customizer, std::size_t index) {
  const Customizer::Parameter& parameter = customizer.parameters()[index];
  Json json = {{"name", parameter.name},
               {"group", parameter.group},
               {"description", parameter.description},
               {"value", json_of(customizer.value(index))},
               {"default", json_of(parameter.value)},
               {"kind", kind_of(parameter.value)}};
  for (const language::ParameterChoice& choice : parameter.choices)
    json["choices"].push_back({{"value", json_of(choice.value)}, {"label", choice.label}});
  if (parameter.range) json["min"] = parameter.range->min;
  if (parameter.range) json["max"] = parameter.range->max;
  if (parameter.longest) json["length"] = *parameter.longest;
  const auto* number = std::get_if<double>(&parameter.value);
  const auto* list = std::get_if<std::vector<double>>(&parameter.value);
  if (number || (list && !list->empty()))
    json["step"] = window::NumberGrid(parameter, number ? *number : list->front()).step();
  return json;
}

// Messages.

int severity_of(MessageGroup group) {
  constexpr int kError = 1, kWarning = 2, kInformation = 3, kHint = 4;
  switch (group) {
    case MessageGroup::kError:
      return kError;
    case MessageGroup::kWarning:
    case MessageGroup::kSoftWarning:
    case MessageGroup::kDeprecated:
      return kWarning;
    case MessageGroup::kTrace:
      return kHint;
    case MessageGroup::kEcho:
    case MessageGroup::kPlain:
      break;
  }
  return kInformation;
}

Json message_of(const Said& said, const PlaceForms& places) {
  Json json = {{"severity", severity_of(said.group)},
               {"group", language::name_of(said.group)},
               {"text", said.what}};
  if (said.text) {
    json["uri"] = places.uri_of(said.path);
    json["range"] = json_of(said.text->range_of(said.span, places.encoding));
  }
  return json;
}

Json place_of(const frontend::TrailStep& step, const language::SourceFiles& files,
              const PlaceForms& places) {
  const Text text(own_text(files[step.at.file].text));
  const Span span = Statements(text.bytes()).from(std::min(step.at.offset, text.size()));
  return {{"uri", places.uri_of(step.place.path)},
          {"range", json_of(text.range_of(span, places.encoding))},
          {"label", step.what}};
}

std::optional<Json> feature_of(const Surface& surface) {
  switch (surface.kind) {
    case Surface::Kind::kVertex:
      return Json{{"kind", "vertex"}, {"points", {json_of(surface.origin)}}};
    case Surface::Kind::kEdge:
      return Json{{"kind", "edge"},
                  {"points", {json_of(surface.ends[0]), json_of(surface.ends[1])}}};
    case Surface::Kind::kCircle:
      return Json{{"kind", "center"}, {"points", {json_of(surface.origin)}}};
    default:
      return std::nullopt;
  }
}

}  // namespace

double number_of(const Json& json, const char* name, double least, double most) {
  const double number = finite(member_of(json, name), name);
  if (number < least || number > most)
    throw invalid("\"" + std::string(name) + "\" is out of its range");
  return number;
}

window::Navigation navigation_of(const Json& json) {
  using csgcore::Projection;
  frontend::Camera camera;
  camera.rotation_deg = vector_of(json, "rotation");
  camera.target = vector_of(json, "translation");
  camera.distance = finite(member_of(json, "distance"), "distance");
  if (json.contains("fov")) finite(json["fov"], "fov");
  const std::string projection = text_of(json, "projection");
  const bool is_perspective = projection == "perspective";
  if (!is_perspective && projection != "ortho")
    throw invalid("\"projection\" is neither \"perspective\" nor \"ortho\"");
  return {camera, is_perspective ? Projection::kPerspective : Projection::kOrthographic};
}

void change_look(const Json& json, Look& look) {
  if (!json.is_object()) throw invalid("\"look\" is no object");
  Look changed = look;
  if (json.contains("width")) changed.size.width_px = side_of(json, "width");
  if (json.contains("height")) changed.size.height_px = side_of(json, "height");
  if (json.contains("camera")) changed.navigation = navigation_of(json["camera"]);
  if (json.contains("moving")) changed.is_moving = flag_of(json, "moving");
  if (json.contains("section")) changed.section = section_of(json["section"]);
  if (json.contains("shading")) {
    const std::string shading = text_of(json, "shading");
    if (shading != "studio" && shading != "flat")
      throw invalid("\"shading\" is neither \"studio\" nor \"flat\"");
    changed.shading =
        shading == "studio" ? frontend::Shading::kStudio : frontend::Shading::kOpenScad;
  }
  if (json.contains("colorscheme")) {
    const auto* scheme = frontend::find_color_scheme(text_of(json, "colorscheme"));
    if (!scheme) throw invalid("there is no such colour scheme");
    changed.scheme = *scheme;
  }
  if (json.contains("axes")) changed.overlays.axes = flag_of(json, "axes");
  if (json.contains("edges")) changed.overlays.edges = flag_of(json, "edges");
  if (json.contains("time")) changed.time = finite(json["time"], "time");
  look = std::move(changed);
}

void change_parameters(const Json& values, Customizer& customizer) {
  if (!values.is_object()) throw invalid("\"values\" is no object");
  std::vector<std::pair<std::size_t, std::optional<Customizer::Value>>> changes;
  for (const auto& [name, value] : values.items()) {
    const auto& all = customizer.parameters();
    const auto found =
        std::ranges::find(all, name, [](const auto& parameter) { return parameter.name; });
    if (found == all.end()) throw invalid("there is no parameter " + name);
    const auto index = static_cast<std::size_t>(found - all.begin());
    changes.emplace_back(index,
                         value.is_null() ? std::nullopt : std::optional(value_of(value, *found)));
  }
  for (auto& [index, value] : changes) {
    if (value)
      customizer.set(index, std::move(*value));
    else
      customizer.reset(index);
  }
}

window::PicturePart part_of(const Json& insets, window::Size size) {
  const double width = size.width_px, height = size.height_px;
  window::PicturePart part;
  part.aspect = width / height;
  if (insets.is_null()) return part;
  part.left = number_of(insets, "left", 0, kMostSide_px) / width;
  part.top = number_of(insets, "top", 0, kMostSide_px) / height;
  part.right = 1 - number_of(insets, "right", 0, kMostSide_px) / width;
  part.bottom = 1 - number_of(insets, "bottom", 0, kMostSide_px) / height;
  if (part.right <= part.left || part.bottom <= part.top)
    throw invalid("the insets leave nothing of the picture");
  return part;
}

Json json_of(const window::Navigation& navigation) {
  const frontend::Camera& camera = navigation.camera();
  const bool is_perspective = navigation.projection() == csgcore::Projection::kPerspective;
  return {{"rotation", json_of(camera.rotation_deg)},
          {"translation", json_of(camera.target)},
          {"distance", camera.distance},
          {"fov", kFieldOfView_deg},
          {"projection", is_perspective ? "perspective" : "ortho"}};
}

Json json_of(const DesignReading& reading, const Customizer& customizer,
             const window::Navigation& now, const PlaceForms& places) {
  Json json = {{"version", reading.version},
               {"ok", reading.is_ok},
               {"bounds", nullptr},
               {"plane", reading.design && reading.design->is_plane_figure},
               {"animated", reading.is_animated},
               {"messages", Json::array()},
               {"parameters", Json::array()},
               {"sets", customizer.set_names()},
               {"set", customizer.set_name()}};
  if (reading.camera != frontend::DesignCamera{}) {
    frontend::Camera camera = now.camera();
    camera.target = reading.camera.target.value_or(camera.target);
    camera.rotation_deg = reading.camera.rotation_deg.value_or(camera.rotation_deg);
    camera.distance = reading.camera.distance.value_or(camera.distance);
    json["camera"] = json_of(window::Navigation(camera, now.projection()));
  }
  if (!reading.bounds.empty())
    json["bounds"] = {{"min", json_of(reading.bounds.min)}, {"max", json_of(reading.bounds.max)}};
  for (const Said& said : reading.said) json["messages"].push_back(message_of(said, places));
  for (std::size_t i = 0; i < customizer.parameters().size(); ++i) {
    const auto& value = customizer.parameters()[i].value;
    if (!std::holds_alternative<language::LiteralText>(value))
      json["parameters"].push_back(json_of(customizer, i));
  }
  return json;
}

Json json_of(const window::Finding& finding, const PlaceForms& places) {
  if (!finding.is_hit) return nullptr;
  const window::PaintOrder& order = finding.probe.order;
  Json json = {{"position", json_of(finding.position)},
               {"normal", json_of(finding.normal)},
               {"flat", finding.surface.kind == Surface::Kind::kPlane},
               {"leaf", finding.place.step().what},
               {"places", Json::array()}};
  if (finding.primitive) {
    const csgcore::Color color =
        shown_color(order.design->scene.primitives[*finding.primitive], order.settings.scheme);
    json["color"] = {color.r, color.g, color.b, color.a};
  }
  if (const auto feature = feature_of(finding.surface)) json["feature"] = *feature;
  if (finding.surface.radius > 0) json["radius"] = finding.surface.radius;
  if (finding.surface.length > 0) json["length"] = finding.surface.length;
  const language::SourceFiles& files = *finding.probe.tree.files;
  for (std::size_t i = finding.place.leaf; i < finding.place.trail.size(); ++i) {
    const frontend::TrailStep& step = finding.place.trail[i];
    if (step.at.file != language::kNoFile) json["places"].push_back(place_of(step, files, places));
  }
  return json;
}

Json json_of(const PreviewFrame& frame, uint64_t preview) {
  return {{"preview", preview},
          {"number", frame.number},
          {"version", frame.version},
          {"width", frame.size.width_px},
          {"height", frame.size.height_px},
          {"final", frame.is_final},
          {"camera", json_of(frame.navigation)},
          {"ms", frame.ms},
          {"type", "image/png"}};
}

}  // namespace serve
