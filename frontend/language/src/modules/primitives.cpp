// cube, square, sphere, circle, cylinder.
#include <cmath>

#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

/// Warns of sizes that make nothing, under --check-parameter-ranges.
void check_range(const BuiltinCall& call, bool is_good, const std::string& what) {
  if (call.environment.checks_ranges && !is_good) warn(call, what);
}

bool is_positive(double size) { return size > 0 && std::isfinite(size); }

/// Reads a radius, or a diameter, which counts if both are given. Returns unset if neither is.
Value read_radius(const BuiltinCall& call, const Value& radius, const Value& diameter,
                  const char* radius_name, const char* diameter_name) {
  if (!diameter.is_number()) return radius.is_number() ? radius : Value::unset();
  if (radius.is_number()) {
    warn(call, filled(call.environment.dialect.ignored_radius, {radius_name, diameter_name}));
  }
  return diameter.number() / 2;
}

/// Returns whether a cylinder of these radii is more than nothing.
bool make_a_solid(double lower, double upper) {
  const bool are_radii = lower >= 0 && upper >= 0 && lower + upper > 0;
  return are_radii && std::isfinite(lower) && std::isfinite(upper);
}

Made make_round(const BuiltinCall& call, NodeTree& tree, NodeKind kind) {
  set_kind(tree, kind);
  const Fragments fragments = clamped_fragments(call);
  const Value radius = read_radius(call, call.parameters[0], call.parameters[1], "r", "d");
  if (radius.is_set()) {
    check_range(call, is_positive(radius.number()),
                std::string(name_of(kind)) + "(r=" + shown(radius) + ")");
  }
  add_fragments(tree, fragments);
  add(tree, "r", number_or(radius, 1));
  return Made::kNode;
}

}  // namespace

Made make_cube(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kCube);
  check_fragments(call);
  const Value& size = call.parameters[0];
  std::array<double, 3> sizes = {1, 1, 1};
  if (is_given(size)) {
    const bool is_vector = size.is_vector() && size.elements().size() == 3;
    const bool converted = size.is_number() || (is_vector && read_vec3(size, sizes, 0));
    if (size.is_number()) sizes.fill(size.number());
    if (!converted) {
      warn(call, "Unable to convert cube(size=" + shown(size) +
                     ", ...) parameter to a number or a vec3 of numbers");
    } else {
      check_range(call, is_positive(sizes[0]) && is_positive(sizes[1]) && is_positive(sizes[2]),
                  "cube(size=" + shown(size) + ", ...)");
    }
  }
  add_numbers(tree, "size", sizes);
  add_bool(tree, "center", is_true_bool(call.parameters[1]));
  return Made::kNode;
}

Made make_square(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kSquare);
  check_fragments(call);
  const Value& size = call.parameters[0];
  std::array<double, 2> sizes = {1, 1};
  if (is_given(size)) {
    const bool converted = size.is_number() || read_vec2(size, sizes[0], sizes[1]);
    if (size.is_number()) sizes.fill(size.number());
    if (!converted) {
      warn(call, "Unable to convert square(size=" + shown(size) +
                     ", ...) parameter to a number or a vec2 of numbers");
    } else {
      check_range(call, is_positive(sizes[0]) && is_positive(sizes[1]),
                  "square(size=" + shown(size) + ", ...)");
    }
  }
  add_numbers(tree, "size", sizes);
  add_bool(tree, "center", is_true_bool(call.parameters[1]));
  return Made::kNode;
}

Made make_sphere(const BuiltinCall& call, NodeTree& tree) {
  return make_round(call, tree, NodeKind::kSphere);
}

Made make_circle(const BuiltinCall& call, NodeTree& tree) {
  return make_round(call, tree, NodeKind::kCircle);
}

Made make_cylinder(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kCylinder);
  enum : size_t { kH, kR1, kR2, kCenter, kR, kD, kD1, kD2 };
  const auto& given = call.parameters;
  const Fragments fragments = clamped_fragments(call);
  const Value r = read_radius(call, given[kR], given[kD], "r", "d");
  const Value r1 = read_radius(call, given[kR1], given[kD1], "r1", "d1");
  const Value r2 = read_radius(call, given[kR2], given[kD2], "r2", "d2");
  const double h = number_or(given[kH], 1);
  if (r.is_set() && (r1.is_set() || r2.is_set())) warn(call, "Cylinder parameters ambiguous");
  check_range(call, is_positive(h), "cylinder(h=" + shown(given[kH]) + ", ...)");
  const double lower = number_or(r1, number_or(r, 1));
  const double upper = number_or(r2, number_or(r, 1));
  check_range(call, make_a_solid(lower, upper),
              "cylinder(r1=" + shown(r1.is_set() ? r1 : r) + ", r2=" + shown(r2.is_set() ? r2 : r) +
                  ", ...)");
  add_fragments(tree, fragments);
  add(tree, "h", h);
  add(tree, "r1", lower);
  add(tree, "r2", upper);
  add_bool(tree, "center", is_true_bool(given[kCenter]));
  return Made::kNode;
}

}  // namespace language
