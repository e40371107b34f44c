// linear_extrude and rotate_extrude.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/number_text.hpp"
#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

/// Reads `origin`; warns if it is given and is no vector of two finite numbers.
void read_origin(const BuiltinCall& call, const Value& origin, const char* module, double& x,
                 double& y) {
  const bool is_good = read_vec2(origin, x, y) && std::isfinite(x) && std::isfinite(y);
  if (is_given(origin) && !is_good) {
    warn(call, std::string(module) + "(..., origin=" + shown(origin) + ") could not be converted");
  }
}

void note_file(const BuiltinCall& call, const char* module) {
  deprecate(call, "Support for reading files in " + std::string(module) +
                      " will be removed in future releases. Use a child import() instead.");
}

/// The arguments of an extrusion that reads a file itself, up to `origin`.
NamedFile add_file(const BuiltinCall& call, NodeTree& tree, const std::string& name,
                   const Value& layer, double x, double y) {
  const NamedFile file = call.environment.files.find(name, call.place);
  add_escaped(tree, "file", file.path);
  add_escaped(tree, "layer", str_or_nothing(layer));
  add_numbers(tree, "origin", {x, y});
  return file;
}

namespace linear {
enum Parameter : size_t {
  kFile,
  kLayer,
  kHeight,
  kOrigin,
  kScale,
  kCenter,
  kTwist,
  kSlices,
  kConvexity
};

/// Reads `scale`: negative factors count as 0, and what is no number as 1. A wrong one is told of
/// only beside an `origin`.
std::array<double, 2> read_scale(const BuiltinCall& call) {
  const Value& scale = call.parameters[kScale];
  std::array<double, 2> factors = {1, 1};
  double x = 1, y = 1;
  if (is_finite_number(scale)) {
    factors.fill(scale.number());
  } else if (read_vec2(scale, x, y) && std::isfinite(x) && std::isfinite(y)) {
    factors = {x, y};
  } else if (is_given(call.parameters[kOrigin])) {
    warn(call, "linear_extrude(..., scale=" + shown(scale) + ") could not be converted");
  }
  for (double& factor : factors) factor = std::max(factor, 0.0);
  return factors;
}

double read_height(const BuiltinCall& call) {
  const Value& given = call.parameters[kHeight];
  const Value& height = is_given(given) ? given : call.first;
  constexpr double kDefault = 100;
  if (!is_finite_number(height)) return kDefault;
  return height.number() > 0 ? height.number() : 0;
}
}  // namespace linear

/// Returns the angle of a rotate_extrude, from -360 to 360 degrees.
double read_angle(const Value& angle) {
  if (!is_finite_number(angle)) return 360;
  return angle.number() <= -360 || angle.number() > 360 ? 360 : angle.number();
}

}  // namespace

bool wants_height(const BuiltinCall& call) {
  if (call.parameters[linear::kFile].is_string()) note_file(call, "linear_extrude");
  return !is_given(call.parameters[linear::kHeight]);
}

Made make_linear_extrude(const BuiltinCall& call, NodeTree& tree) {
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kLinearExtrude);
  const std::string name(text_or(given[linear::kFile], ""));
  if (given[linear::kFile].is_string()) note_file(call, "linear_extrude");
  double x = 0, y = 0;
  read_origin(call, given[linear::kOrigin], "linear_extrude", x, y);
  const std::array<double, 2> scale = linear::read_scale(call);
  if (!name.empty()) {
    const NamedFile file = add_file(call, tree, name, given[linear::kLayer], x, y);
    add_integer(tree, "timestamp", file.timestamp);
  }
  add(tree, "height", linear::read_height(call));
  add_bool(tree, "center", is_true_bool(given[linear::kCenter]));
  add_integer(tree, "convexity", std::max(integer_or(call, given[linear::kConvexity], 0), 1));
  const Value& twist = given[linear::kTwist];
  if (is_finite_number(twist) && twist.number() != 0) add(tree, "twist", twist);
  const int slices = integer_or(call, given[linear::kSlices], 0);
  if (slices >= 1) add_integer(tree, "slices", slices);
  add_numbers(tree, "scale", scale);
  if (slices < 1) add_fragments(tree, fragments_of(call));
  return name.empty() ? Made::kNode : Made::kLeaf;
}

namespace {

/// Reads a whole number of 0 and more; nothing where there is none, which is told of what is no
/// finite number.
std::optional<int64_t> read_count(const BuiltinCall& call, const Value& value,
                                  const std::string& name, int64_t least) {
  if (value.is_number() && !is_finite_number(value)) {
    warn(call, "linear_extrude(..., " + name + "=" + shown(value) +
                   ") argument cannot be infinite or nan");
    return std::nullopt;
  }
  if (value.is_number())
    return std::max(static_cast<int64_t>(nearest_count(value.number())), least);
  if (is_given(value)) warn(call, wrong_type("linear_extrude", name, "number", value));
  return std::nullopt;
}

/// Returns the one of a parameter's two names that is given; told where both are.
const Value& one_of(const BuiltinCall& call, const Value& value, const Value& other,
                    std::string_view name, std::string_view other_name) {
  if (is_given(value) && is_given(other)) {
    warn(call,
         "Specified both \"" + std::string(name) + "\" and \"" + std::string(other_name) + "\"");
  }
  return is_given(value) ? value : other;
}

void say_error(const BuiltinCall& call, std::string text) {
  call.environment.messages.say(MessageGroup::kError, std::move(text));
}

using Vector = std::array<double, 3>;

double length_of(const Vector& vector) {
  return std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/// Reads a `v`; one that is wrong gives the numbers before its first element that is none.
Vector read_direction(const BuiltinCall& call, const Value& v) {
  Vector direction = {0, 0, 1};
  if (!is_given(v)) return direction;
  size_t read = 0;
  if (v.is_vector() && v.elements().size() == direction.size()) {
    while (read < direction.size() && v.elements()[read].is_number()) {
      direction[read] = v.elements()[read].number();
      ++read;
    }
  }
  if (read < direction.size()) say_error(call, "v when specified should be a 3d vector.");
  return direction;
}

/// Returns the vector along which is extruded, without what leads down.
Vector read_sweep(const BuiltinCall& call, const Value& v, const Value& named_height,
                  const Value& h) {
  Vector sweep = read_direction(call, v);
  const Value& height = one_of(call, named_height, h, "height", "h");
  if (is_given(height) || !is_given(v)) {
    constexpr double kDefault = 100;
    const double length = length_of(sweep);
    for (double& part : sweep) {
      if (length > 0) part /= length;
      part *= is_finite_number(height) ? height.number() : kDefault;
    }
  }
  if (is_given(height) && !is_finite_number(height))
    say_error(call, "height when specified should be a number.");
  if (sweep[2] <= 0) sweep[2] = 0;
  return sweep;
}

}  // namespace

Made make_linear_extrude_2026(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kHeight, kV, kScale, kCenter, kTwist, kSlices, kSegments, kConvexity, kH };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kLinearExtrude);
  const Vector sweep = read_sweep(call, given[kV], given[kHeight], given[kH]);
  std::array<double, 2> scale = {1, 1};
  double x = 1, y = 1;
  if (is_finite_number(given[kScale])) {
    scale.fill(given[kScale].number());
  } else if (read_vec2(given[kScale], x, y) && std::isfinite(x) && std::isfinite(y)) {
    scale = {x, y};
  } else if (is_given(given[kScale])) {
    warn(call, "linear_extrude(..., scale=" + shown(given[kScale]) + ") could not be converted");
  }
  for (double& factor : scale) factor = std::max(factor, 0.0);
  const auto slices = read_count(call, given[kSlices], "slices", 1);
  const auto segments = read_count(call, given[kSegments], "segments", 0);
  const double height = length_of(sweep);
  const Vector direction = {sweep[0] / height, sweep[1] / height, sweep[2] / height};
  add(tree, "height", height);
  if (direction[2] < 1) add_numbers(tree, "v", direction, ArgumentStyle::kGeneralSpaced);
  if (is_true_bool(given[kCenter])) add_bool(tree, "center", true);
  const Value& twist = given[kTwist];
  if (is_finite_number(twist) && twist.number() != 0) add(tree, "twist", twist);
  if (slices) add_integer(tree, "slices", *slices);
  if (segments) add_integer(tree, "segments", *segments);
  if (scale[0] != scale[1]) {
    add_numbers(tree, "scale", scale);
  } else if (scale[0] != 1) {
    add(tree, "scale", scale[0]);
  }
  if (!slices || !segments) add_fragments(tree, fragments_of(call));
  const Value& number = given[kConvexity];
  constexpr double kMost = std::numeric_limits<uint32_t>::max();
  const bool has_convexity = number.is_number() && number.number() <= kMost;
  const uint32_t convexity = has_convexity ? nearest_count(number.number()) : 1;
  if (convexity > 1) add_integer(tree, "convexity", convexity);
  return Made::kNode;
}

Made make_rotate_extrude_2026(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kAngle, kStart, kConvexity, kA };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kRotateExtrude);
  const Value& angle = one_of(call, given[kAngle], given[kA], "angle", "a");
  const bool has_angle = is_finite_number(angle);
  const Fragments fragments = fragments_of(call);
  double start = has_angle ? 0 : 180;
  if (is_finite_number(given[kStart])) {
    start = given[kStart].number();
  } else if (!has_angle && integer_or(call, fragments.number, 0) % 2 != 0) {
    deprecate(call,
              "In future releases, rotational extrusion without \"angle\" will start at zero, the "
              "+X axis.  Set start=180 to explicitly start on the -X axis.");
  }
  const int convexity = integer_or(call, given[kConvexity], 0);
  add(tree, "angle", read_angle(angle));
  add(tree, "start", start);
  add_integer(tree, "convexity", convexity <= 0 ? 2 : convexity);
  add_fragments(tree, fragments);
  return Made::kNode;
}

namespace rotated {
enum Parameter : size_t { kFile, kLayer, kOrigin, kScale, kConvexity, kAngle };
}  // namespace rotated

Made make_rotate_extrude(const BuiltinCall& call, NodeTree& tree) {
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kRotateExtrude);
  const std::string name = str_or_nothing(given[rotated::kFile]);
  if (is_given(given[rotated::kFile])) note_file(call, "rotate_extrude");
  double x = 0, y = 0;
  read_origin(call, given[rotated::kOrigin], "rotate_extrude", x, y);
  if (!name.empty()) {
    const NamedFile file = add_file(call, tree, name, given[rotated::kLayer], x, y);
    const double scale = number_or(given[rotated::kScale], 1);
    add(tree, "scale", scale <= 0 ? 1 : scale);
    add_integer(tree, "timestamp", file.timestamp);
  }
  const int convexity = integer_or(call, given[rotated::kConvexity], 0);
  add(tree, "angle", read_angle(given[rotated::kAngle]));
  add_integer(tree, "convexity", convexity <= 0 ? 2 : convexity);
  add_fragments(tree, fragments_of(call));
  return name.empty() ? Made::kNode : Made::kLeaf;
}

}  // namespace language
