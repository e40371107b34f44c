// polyhedron and polygon: their lists are written as they are, and checked where geometry is made.
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/evaluation_thread.hpp"
#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"
#include "values/function_object.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

/// Stands for a value that holds functions: these do not outlive the evaluation, as nodes do.
struct SpelledValue final : FunctionObject {
  explicit SpelledValue(std::string spelled) : text(std::move(spelled)) {}
  void append_text(std::string& out) const override { out += text; }

  const std::string text;
};

bool holds_function(const Value& value) {
  if (value.is_function()) return true;
  if (!value.is_vector()) return false;
  std::vector<std::span<const Value>> pending = {value.elements()};
  while (!pending.empty()) {
    const std::span<const Value> elements = pending.back();
    pending.pop_back();
    count_work(elements.size());
    for (const Value& element : elements) {
      if (element.is_function()) return true;
      if (element.is_vector()) pending.push_back(element.elements());
    }
  }
  return false;
}

void add_list(NodeTree& tree, ArgumentName name, const Value& list) {
  Value kept = list.is_set() ? list : Value::undef();
  if (holds_function(kept)) {
    std::string text;
    append_value_text(text, kept);
    kept = Value::adopt(new SpelledValue(std::move(text)));
  }
  add(tree, name, std::move(kept), ArgumentStyle::kEcho);
}

void add_convexity(NodeTree& tree, const Value& convexity) {
  add_integer(tree, "convexity", std::max(integer_or(convexity, 0), 1));
}

}  // namespace

Made make_polyhedron(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kPoints, kFaces, kConvexity, kTriangles };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kPolyhedron);
  check_fragments(call);
  const bool has_triangles = !is_given(given[kFaces]) && is_given(given[kTriangles]);
  if (has_triangles) {
    deprecate(call,
              "polyhedron(triangles=[]) will be removed in future releases. Use "
              "polyhedron(faces=[]) instead.");
  }
  add_list(tree, "points", given[kPoints]);
  add_list(tree, "faces", given[has_triangles ? kTriangles : kFaces]);
  add_convexity(tree, given[kConvexity]);
  return Made::kNode;
}

Made make_polygon(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kPolygon);
  check_fragments(call);
  add_list(tree, "points", call.parameters[0]);
  add_list(tree, "paths", call.parameters[1]);
  add_convexity(tree, call.parameters[2]);
  return Made::kNode;
}

}  // namespace language
