// linear_extrude and rotate_extrude.
#include <algorithm>
#include <array>
#include <cmath>

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
  const NamedFile file = call.environment.files.find(name);
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
  add_integer(tree, "convexity", std::max(integer_or(given[linear::kConvexity], 0), 1));
  const Value& twist = given[linear::kTwist];
  if (is_finite_number(twist) && twist.number() != 0) add(tree, "twist", twist);
  const int slices = integer_or(given[linear::kSlices], 0);
  if (slices >= 1) add_integer(tree, "slices", slices);
  add_numbers(tree, "scale", scale);
  if (slices < 1) add_fragments(tree, fragments_of(call));
  return name.empty() ? Made::kNode : Made::kLeaf;
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
  const int convexity = integer_or(given[rotated::kConvexity], 0);
  add(tree, "angle", read_angle(given[rotated::kAngle]));
  add_integer(tree, "convexity", convexity <= 0 ? 2 : convexity);
  add_fragments(tree, fragments_of(call));
  return name.empty() ? Made::kNode : Made::kLeaf;
}

}  // namespace language
