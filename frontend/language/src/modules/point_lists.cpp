// polyhedron and polygon: their lists are written as they are, and checked where geometry is made.
#include <algorithm>

#include "modules/makers.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

void add_list(Node& node, std::string_view name, const Value& list) {
  add(node, name, list.is_set() ? list : Value::undef(), ArgumentStyle::kEcho);
}

void add_convexity(Node& node, const Value& convexity) {
  add_integer(node, "convexity", std::max(integer_or(convexity, 0), 1));
}

}  // namespace

Made make_polyhedron(const BuiltinCall& call, Node& node) {
  enum : size_t { kPoints, kFaces, kConvexity, kTriangles };
  const auto& given = call.parameters;
  node.name = "polyhedron";
  check_fragments(call);
  const bool has_triangles = !is_given(given[kFaces]) && is_given(given[kTriangles]);
  if (has_triangles) {
    deprecate(call,
              "polyhedron(triangles=[]) will be removed in future releases. Use "
              "polyhedron(faces=[]) instead.");
  }
  add_list(node, "points", given[kPoints]);
  add_list(node, "faces", given[has_triangles ? kTriangles : kFaces]);
  add_convexity(node, given[kConvexity]);
  return Made::kNode;
}

Made make_polygon(const BuiltinCall& call, Node& node) {
  node.name = "polygon";
  check_fragments(call);
  add_list(node, "points", call.parameters[0]);
  add_list(node, "paths", call.parameters[1]);
  add_convexity(node, call.parameters[2]);
  return Made::kNode;
}

}  // namespace language
