// projection, offset, hull, minkowski, render, resize.
#include <algorithm>
#include <array>

#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

/// The convexity of the nodes that write it without a sign.
int64_t unsigned_convexity(const BuiltinCall& call, const Value& value) {
  return static_cast<uint32_t>(integer_or(call, value, 0));
}

/// Reads resize()'s `auto`: 0 or 1 for each axis.
std::array<double, 3> read_auto(const Value& value) {
  std::array<double, 3> is_auto = {0, 0, 0};
  if (is_true_bool(value)) is_auto.fill(1);
  if (value.is_vector()) {
    const std::span<const Value> elements = value.elements();
    for (size_t i = 0; i < std::min<size_t>(elements.size(), 3); ++i) {
      is_auto[i] = elements[i].is_true() ? 1 : 0;
    }
  }
  return is_auto;
}

}  // namespace

Made make_projection(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kProjection);
  add_bool(tree, "cut", is_true_bool(call.parameters[0]));
  add_integer(tree, "convexity", integer_or(call, call.parameters[1], 0));
  return Made::kNode;
}

Made make_offset(const BuiltinCall& call, NodeTree& tree) {
  const Value& r = call.parameters[0];
  const Value& delta = call.parameters[1];
  set_kind(tree, NodeKind::kOffset);
  if (delta.is_number() && !r.is_number()) {
    add(tree, "delta", delta);
    add_bool(tree, "chamfer", is_true_bool(call.parameters[2]));
  } else {
    add(tree, "r", number_or(r, 1));
  }
  add_fragments(tree, fragments_of(call));
  return Made::kNode;
}

Made make_fill(const BuiltinCall&, NodeTree& tree) {
  set_kind(tree, NodeKind::kFill);
  return Made::kNode;
}

Made make_hull(const BuiltinCall&, NodeTree& tree) {
  set_kind(tree, NodeKind::kHull);
  return Made::kNode;
}

Made make_roof(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kRoof);
  constexpr std::string_view kDefault = "voronoi";
  std::string method = str_or_nothing(call.parameters[0]);
  if (!is_given(call.parameters[0])) method = kDefault;
  if (method != kDefault && method != "straight") {
    warn(call, "Unknown roof method '" + method + "'. Using 'voronoi'.");
    method = kDefault;
  }
  const Value& convexity = call.parameters[1];
  Fragments fragments = fragments_of(call);
  if (fragments.number > 0) {
    fragments = {fragments.number, 360 / fragments.number, 0};
  } else {
    constexpr double kLeast = 0.01;
    for (double* const setting : {&fragments.angle, &fragments.size})
      if (*setting < kLeast) *setting = kLeast;
  }
  add_raw(tree, "method", method);
  add(tree, "$fa", fragments.angle);
  add(tree, "$fs", fragments.size);
  add(tree, "$fn", fragments.number);
  add_integer(tree, "convexity",
              std::max(is_finite_number(convexity) ? integer_or(call, convexity, 1) : 1, 1));
  return Made::kNode;
}

Made make_minkowski(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kMinkowski);
  add_integer(tree, "convexity", unsigned_convexity(call, call.parameters[0]));
  return Made::kNode;
}

Made make_render(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kRender);
  add_integer(tree, "convexity", integer_or(call, call.parameters[0], 1));
  return Made::kNode;
}

Made make_resize(const BuiltinCall& call, NodeTree& tree) {
  const Value& new_size = call.parameters[0];
  set_kind(tree, NodeKind::kResize);
  std::array<double, 3> sizes = {0, 0, 0};
  if (new_size.is_vector()) {
    const std::span<const Value> elements = new_size.elements();
    for (size_t i = 0; i < std::min<size_t>(elements.size(), 3); ++i) {
      sizes[i] = number_or(elements[i], 0);
    }
  }
  add_numbers(tree, "newsize", sizes, ArgumentStyle::kGeneralTight);
  add_numbers(tree, "auto", read_auto(call.parameters[1]), ArgumentStyle::kGeneralTight);
  add_integer(tree, "convexity", unsigned_convexity(call, call.parameters[2]));
  return Made::kNode;
}

}  // namespace language
