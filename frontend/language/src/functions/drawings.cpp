// dxf_dim() and dxf_cross(): what a drawing's dimensions and crossing lines tell.
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "base/number_text.hpp"
#include "base/read_file.hpp"
#include "functions/builtin_functions.hpp"
#include "language/degrees.hpp"
#include "language/dxf.hpp"
#include "language/dxf_chains.hpp"
#include "language/make.hpp"
#include "values/value_text.hpp"

namespace language::functions {
namespace {

/// What a call's arguments ask for.
struct Request {
  std::string file, layer, name;
  DxfPoint origin{};
  double scale = 1;
};

std::string str_text(const Value& value) {
  std::string text;
  append_str_text(text, value);
  return text;
}

/// Reads a vector of two numbers; leaves the point if the value is none.
bool read_point(const Value& value, DxfPoint& point) {
  if (!value.is_vector() || value.elements().size() != 2) return false;
  const Value &x = value.elements()[0], &y = value.elements()[1];
  if (!x.is_number() || !y.is_number()) return false;
  point = {x.number(), y.number()};
  return true;
}

/// Takes what an argument says. Returns what is wrong with it, or an empty text.
std::string take(std::string_view name, const Value& value, bool has_name, Request& request) {
  if (name == "file") {
    request.file = str_text(value);
  } else if (name == "layer") {
    request.layer = str_text(value);
  } else if (name == "name" && has_name) {
    request.name = str_text(value);
  } else if (name == "scale") {
    if (value.is_number()) request.scale = value.number();
  } else if (name == "origin") {
    const bool is_point = read_point(value, request.origin);
    if (!is_point || !std::isfinite(request.origin.x) || !std::isfinite(request.origin.y))
      return "origin=" + echo_text(value) + ") could not be converted";
  } else {
    return std::string(name) + "=...) is not supported";
  }
  return {};
}

bool has_name(const FunctionCall& call) { return call.name == "dxf_dim"; }

Request request_of(const FunctionCall& call) {
  Request request;
  const bool has_names = call.environment.dialect.has_lazy_functions;
  for (size_t i = 0; i < call.arguments.size(); ++i) {
    const Value& value = call.arguments[i];
    if (has_names) {
      take(call.names[i], value, has_name(call), request);
    } else if (value.is_set()) {
      const std::string problem = take(kDrawingParameters[i], value, true, request);
      if (!problem.empty()) call.warn(std::string(call.name) + "(..., " + problem);
    }
  }
  return request;
}

void say(const FunctionCall& call, const NamedFile& file, const std::string& layer,
         const DxfProblem& problem) {
  Messages& messages = call.environment.messages;
  const std::string word(problem.word);
  const auto say_softly = [&](std::string text) {
    messages.say(MessageGroup::kSoftWarning, std::move(text));
  };
  switch (problem.kind) {
    case DxfProblem::Kind::kIllegalCode:
      return say_softly("Illegal ID '" + word + "' in `" + file.opened + "'");
    case DxfProblem::Kind::kIllegalValue:
      return say_softly("Illegal value '" + word + "'in `" + file.opened + "'");
    case DxfProblem::Kind::kMissingPoints:
      return say_softly("Not enough input values for " + word + ". in '" + file.opened + "'");
    case DxfProblem::Kind::kTooManyStrokes:
      return;  // OpenSCAD would read on, for any time
    case DxfProblem::Kind::kUnsupported:
      break;
  }
  std::array<char, 17> count{};
  std::snprintf(count.data(), count.size(), "%llx", static_cast<unsigned long long>(problem.count));
  messages.warn(
      "Unsupported DXF Entity '" + word + "' (" + count.data() + ") in " +
      (layer.empty() ? "\"" + file.path + "\"." : "layer '" + layer + "' of " + file.path));
}

DxfContents contents_of(const FunctionCall& call, const NamedFile& file, const Request& request) {
  constexpr int kFragments = 36;  // whatever $fn, $fa and $fs say
  const DxfSettings settings = {
      request.layer, request.origin, request.scale, [](double) { return kFragments; },
      [&](const DxfProblem& problem) { say(call, file, request.layer, problem); }};
  std::error_code failed;
  if (std::filesystem::is_directory(file.opened, failed)) {  // which can be opened, but not read
    settings.tell({DxfProblem::Kind::kIllegalCode, ""});
    return {};
  }
  const std::optional<std::string> text = read_regular_file(file.opened);
  if (text) return read_dxf(*text, settings);
  call.environment.messages.warn("Can't open DXF file '" + file.opened + "'.");
  return {};
}

double distance(DxfPoint a, DxfPoint b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

/// Returns an angle from the y axis.
double direction_deg(DxfPoint from, DxfPoint to) {
  return std::atan2(to.x - from.x, to.y - from.y) * (180 / std::numbers::pi);
}

/// Returns what a dimension measures; undef for one that OpenSCAD does not know.
Value measure(const DxfDimension& dimension) {
  const auto& points = dimension.points;
  constexpr int kKinds = 7, kIsX = 64;
  switch (dimension.type & kKinds) {
    case 0: {  // along a direction
      const double x = points[4].x - points[3].x, y = points[4].y - points[3].y;
      return std::abs(x * cosine_of_degrees(dimension.angle_deg) +
                      y * sine_of_degrees(dimension.angle_deg));
    }
    case 1:  // between two points
      return distance(points[3], points[4]);
    case 2:  // between two lines
      return std::abs(direction_deg(points[5], points[0]) - direction_deg(points[3], points[4]));
    case 3:  // a diameter
    case 4:  // a radius
      return distance(points[0], points[5]);
    case 6:  // a coordinate
      return (dimension.type & kIsX) != 0 ? points[3].x : points[3].y;
    default:
      return Value::undef();
  }
}

/// Returns undef, with a warning that names the request between `before` and `after`.
Value refuse(const FunctionCall& call, const Request& request, const std::string& before,
             const std::string& after) {
  call.warn(before + "'" + request.file + "', layer '" + request.layer + "'" + after);
  return Value::undef();
}

Value find_dimension(const FunctionCall& call, const NamedFile& file, const Request& request) {
  for (const DxfDimension& dimension : contents_of(call, file, request).dimensions) {
    if (!request.layer.empty() && dimension.layer != request.layer) continue;
    if (!request.name.empty() && dimension.name != request.name) continue;
    Value value = measure(dimension);
    if (!value.is_undef()) return value;
    return refuse(call, request, "Dimension '" + request.name + "' in ", " has unsupported type!");
  }
  return refuse(call, request, "Can't find dimension '" + request.name + "' in ", "!");
}

/// Looks at the first two chains that are single lines.
Value find_cross(const FunctionCall& call, const NamedFile& file, const Request& request) {
  DxfChains chains;
  for (const DxfStroke& stroke : contents_of(call, file, request).strokes)
    chains.add_chords(stroke);
  std::vector<DxfPoint> ends;
  for (const DxfChains::Chain& chain : chains.join()) {
    if (chain.size() != 2 || ends.size() == 4) continue;
    for (const DxfChains::Step& step : chain) ends.push_back(chains.place(step.point));
  }
  if (ends.size() == 4) {
    const auto [a, b, c, d] = std::array<DxfPoint, 4>{ends[0], ends[1], ends[2], ends[3]};
    const double area = (d.y - c.y) * (b.x - a.x) - (d.x - c.x) * (b.y - a.y);
    const double share = ((d.x - c.x) * (a.y - c.y) - (d.y - c.y) * (a.x - c.x)) / area;
    const std::array<Value, 2> point = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
    if (area != 0) return make_vector(point);
  }
  return refuse(call, request, "Can't find cross in ", "!");
}

/// What was found is found again without a look at the file, as long as that is the same.
std::string key_of(const FunctionCall& call, const NamedFile& file, const Request& request) {
  std::string key(call.name);
  for (const std::string& text : {file.opened, request.layer, request.name}) key += '|' + text;
  for (const double number : {request.origin.x, request.origin.y, request.scale}) {
    key += '|';
    append_general_number(key, number);
  }
  return key + '|' + std::to_string(file.timestamp) + '|' + std::to_string(file.size);
}

Value look_up(const FunctionCall& call,
              Value (*find)(const FunctionCall&, const NamedFile&, const Request&)) {
  const Request request = request_of(call);
  const NamedFile file = call.environment.files.find(request.file, call.place);
  if (!file.exists) {
    call.warn("Can't open DXF file '" + request.file + "'!");
    return Value::undef();
  }
  Value& found = call.environment.measures[key_of(call, file, request)];
  if (found.is_undef()) found = find(call, file, request);
  return found;
}

}  // namespace

size_t next_of_drawing(const FunctionCall& call) {
  const size_t count = call.arguments.size();
  if (count > 0) {
    Request request;
    const std::string problem =
        take(call.names[count - 1], call.arguments.back(), has_name(call), request);
    if (!problem.empty()) call.warn(std::string(call.name) + "(..., " + problem);
  }
  return count < call.written ? count : kNoArgument;
}

Value drawing_dimension(const FunctionCall& call) { return look_up(call, find_dimension); }
Value drawing_cross(const FunctionCall& call) { return look_up(call, find_cross); }

}  // namespace language::functions
