// polyhedron and polygon: their lists are written as they are, and checked where geometry is made.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/evaluation_thread.hpp"
#include "base/number_text.hpp"
#include "language/make.hpp"
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

void add_convexity(const BuiltinCall& call, NodeTree& tree, const Value& convexity) {
  add_integer(tree, "convexity", std::max(integer_or(call, convexity, 0), 1));
}

/// Reads lists of points and of their numbers as 2026 does: what is wrong is told, and left out or
/// 0.
class CheckedLists {
 public:
  CheckedLists(const BuiltinCall& call, size_t dimension) : call_(call), dimension_(dimension) {}

  /// Reads points; nothing if the value is no vector.
  std::optional<Value> points(const Value& list) {
    if (!list.is_vector()) {
      say("points", list, "a vector of coordinates");
      return std::nullopt;
    }
    Value points = make_vector(list.elements().size());
    size_t number = 0;
    for (const Value& element : list.elements()) {
      count_work();
      append_element(points, point(element, number++));
    }
    return points;
  }

  /// Reads lists of at least so many numbers of points; nothing if the value is no vector.
  std::optional<Value> index_lists(const Value& lists, const char* name, size_t points,
                                   size_t least) {
    if (!lists.is_vector()) {
      say(name, lists, "a vector of vector of point indices");
      return std::nullopt;
    }
    Value read = make_vector();
    size_t number = 0;
    for (const Value& list : lists.elements()) {
      const std::string where = std::string(name) + "[" + std::to_string(number++) + "]";
      if (!list.is_vector()) {
        say(where, list, "a vector of numbers");
        continue;
      }
      Value indices = index_list(list.elements(), where, points);
      if (indices.elements().size() >= least) append_element(read, std::move(indices));
    }
    return read;
  }

 private:
  Value point(const Value& element, size_t number) {
    std::array<double, 3> xyz{};
    std::span<const Value> parts;
    if (element.is_vector()) parts = element.elements();
    // Two coordinates lie in the plane z = 0.
    bool is_good = parts.size() == dimension_ || (parts.size() == 2 && dimension_ == 3);
    for (size_t i = 0; is_good && i < parts.size(); ++i) {
      is_good = is_finite_number(parts[i]);
      if (is_good) xyz[i] = parts[i].number();
    }
    if (!is_good) {
      xyz = {};
      say("points[" + std::to_string(number) + "]", element,
          "a vec" + std::to_string(dimension_) + " of numbers");
    }
    Value made = make_vector(dimension_);
    for (size_t i = 0; i < dimension_; ++i) append_element(made, xyz[i]);
    return made;
  }

  Value index_list(std::span<const Value> list, const std::string& where, size_t points) {
    Value indices = make_vector(list.size());
    for (size_t i = 0; i < list.size(); ++i) {
      count_work();
      const std::string place = where + "[" + std::to_string(i) + "]";
      if (!list[i].is_number()) {
        say(place, list[i], "a number");
        continue;
      }
      const uint32_t index = nearest_count(list[i].number());
      if (index < points) {
        append_element(indices, static_cast<double>(index));
        continue;
      }
      warn(call_,
           "Point index " + std::to_string(index) + " is out of bounds (from " + place + ")");
    }
    return indices;
  }

  void say(const std::string& what, const Value& found, const std::string& expected) {
    call_.environment.messages.say(
        MessageGroup::kError,
        "Unable to convert " + what + " = " + shown(found) + " to " + expected, call_.place,
        PathBase::kMainFile);
  }

  const BuiltinCall& call_;
  size_t dimension_;
};

}  // namespace

Made make_polyhedron_2026(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kPoints, kFaces, kConvexity, kTriangles };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kPolyhedron);
  CheckedLists lists(call, 3);
  const auto points = lists.points(given[kPoints]);
  Value faces = make_vector();
  int convexity = 1;
  if (points) {
    const bool has_triangles = !is_given(given[kFaces]) && is_given(given[kTriangles]);
    if (has_triangles) {
      call.environment.messages.say(MessageGroup::kDeprecated,
                                    "polyhedron(triangles=[]) will be removed in future releases. "
                                    "Use polyhedron(faces=[]) instead.",
                                    call.place, PathBase::kMainFile);
    }
    constexpr size_t kLeastCorners = 3;
    const auto read = lists.index_lists(given[has_triangles ? kTriangles : kFaces], "faces",
                                        points->elements().size(), kLeastCorners);
    if (read) {
      faces = *read;
      convexity = std::max(integer_or(call, given[kConvexity], 0), 1);
    }
  }
  add(tree, "points", points.value_or(make_vector()), ArgumentStyle::kGeneralLists);
  add(tree, "faces", std::move(faces), ArgumentStyle::kGeneralLists);
  add_integer(tree, "convexity", convexity);
  return Made::kNode;
}

Made make_polygon_2026(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kPoints, kPaths, kConvexity };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kPolygon);
  CheckedLists lists(call, 2);
  const auto points = lists.points(given[kPoints]);
  auto paths = points ? std::optional(make_vector()) : std::nullopt;
  if (points && is_given(given[kPaths]))
    paths = lists.index_lists(given[kPaths], "paths", points->elements().size(), 0);
  const bool has_paths = paths && !paths->elements().empty();
  add(tree, "points", points.value_or(make_vector()), ArgumentStyle::kGeneralLists);
  add(tree, "paths", has_paths ? *paths : Value::undef(), ArgumentStyle::kGeneralLists);
  add_integer(tree, "convexity", paths ? std::max(integer_or(call, given[kConvexity], 0), 1) : 1);
  return Made::kNode;
}

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
  add_convexity(call, tree, given[kConvexity]);
  return Made::kNode;
}

Made make_polygon(const BuiltinCall& call, NodeTree& tree) {
  set_kind(tree, NodeKind::kPolygon);
  check_fragments(call);
  add_list(tree, "points", call.parameters[0]);
  add_list(tree, "paths", call.parameters[1]);
  add_convexity(call, tree, call.parameters[2]);
  return Made::kNode;
}

}  // namespace language
