#include "lower/read_2d.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lower/argument_lookup.hpp"

namespace frontend {
namespace {

/// The value as OpenSCAD prints it.
std::string printed(const SyntaxTree& tree, const Value& value) {
  if (value.kind == ValueKind::kString) return '"' + std::string(tree.text_of(value)) + '"';
  if (value.kind != ValueKind::kList) return scalar_text(value);
  std::string text = "[";
  for (const Value& element : tree.elements_of(value)) {
    if (text.size() > 1) text += ", ";
    // No point holds lists; what is deeper does not matter.
    text += element.kind == ValueKind::kList ? "[...]" : printed(tree, element);
  }
  return text + "]";
}

std::optional<Vec2> pair_of(const SyntaxTree& tree, const Value& value) {
  if (value.kind != ValueKind::kList || value.count != 2) return std::nullopt;
  const std::span<const Value> elements = tree.elements_of(value);
  if (elements[0].kind != ValueKind::kNumber || elements[1].kind != ValueKind::kNumber) {
    return std::nullopt;
  }
  return Vec2(elements[0].number, elements[1].number);
}

bool is_true(const Value* value) {
  return value != nullptr && value->kind == ValueKind::kBool && value->boolean;
}

/// An element of a list of switches, which OpenSCAD writes as numbers.
bool is_on(const Value& value) {
  return is_true(&value) || (value.kind == ValueKind::kNumber && value.number != 0);
}

bool is_given(const Value* value) { return value != nullptr && value->kind != ValueKind::kUndef; }

/// The points; nothing if one of them is none.
std::optional<Polygon> read_points(const SyntaxTree& tree, const SyntaxNode& node,
                                   NodeProblems& problems) {
  const std::span<const Value> values = list_argument(tree, node, "points", 0, problems);
  Polygon points;
  points.reserve(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const std::optional<Vec2> point = pair_of(tree, values[i]);
    if (!point || std::isinf(point->x) || std::isinf(point->y)) {
      problems.add(node, {": Unable to convert points[" + std::to_string(i) +
                              "] = " + printed(tree, values[i]) + " to a vec2 of numbers",
                          "it is left out"});
      return std::nullopt;
    }
    if (std::isnan(point->x) || std::isnan(point->y)) {
      problems.add(node, {": Range check failed", "it is left out"});
      return std::nullopt;
    }
    points.push_back(*point);
  }
  return points;
}

/// OpenSCAD's unsigned index: fractions are truncated, negative numbers wrap around.
uint32_t index_of(const Value& value) {
  if (value.kind != ValueKind::kNumber || !std::isfinite(value.number)) return 0;
  constexpr double kLargest = 4294967296.0;  // 2^32
  const double number = std::trunc(value.number);
  if (number >= kLargest || number <= -kLargest) return 0xFFFFFFFFu;
  return static_cast<uint32_t>(static_cast<int64_t>(number));
}

Polygon read_path(const SyntaxTree& tree, const Polygon& points, const Value& path,
                  size_t path_index, ElementProblem& beyond_points) {
  Polygon result;
  if (path.kind != ValueKind::kList) return result;
  const std::span<const Value> indices = tree.elements_of(path);
  for (size_t i = 0; i < indices.size(); ++i) {
    const uint32_t index = index_of(indices[i]);
    if (index < points.size()) {
      result.push_back(points[index]);
      continue;
    }
    beyond_points.add([&] {
      return NodeProblems::Description{
          ": Point index " + std::to_string(index) + " is out of bounds (from paths[" +
              std::to_string(path_index) + "][" + std::to_string(i) + "])",
          "it is left out of its path"};
    });
  }
  return result;
}

/// A number of at least 1, without its fraction.
std::optional<double> count_argument(const SyntaxTree& tree, const SyntaxNode& node,
                                     std::string_view name) {
  const std::optional<double> value = number_argument(tree, node, name);
  if (!value || !(*value >= 1) || !std::isfinite(*value)) return std::nullopt;
  return std::trunc(*value);
}

/// Three finite numbers.
std::optional<std::array<double, 3>> triple_of(const SyntaxTree& tree, const Value* value) {
  if (value == nullptr || value->kind != ValueKind::kList || value->count != 3) return std::nullopt;
  std::array<double, 3> result{};
  for (size_t i = 0; i < result.size(); ++i) {
    const Value& element = tree.elements_of(*value)[i];
    if (element.kind != ValueKind::kNumber || !std::isfinite(element.number)) return std::nullopt;
    result[i] = element.number;
  }
  return result;
}

/// Height and direction. A direction alone is as long as the extrusion; with a height it is the
/// direction only.
void read_height(const SyntaxTree& tree, const SyntaxNode& node, LinearExtrudeArguments& result) {
  std::optional<double> height = number_argument(tree, node, "height", 0);
  if (!height) height = number_argument(tree, node, "h");
  if (height && std::isfinite(*height)) result.height = *height;
  const auto direction = triple_of(tree, find_argument(tree, node, "v", kByNameOnly));
  if (!direction) return;
  const auto [x, y, z] = *direction;
  const double length = std::hypot(x, y, z);
  const double share = height && length > 0 ? result.height / length : 1;
  result.height = share * z;
  result.lean = share * Vec2(x, y);
}

Vec2 read_top_scale(const SyntaxTree& tree, const SyntaxNode& node) {
  Vec2 scale(1.0);
  const Value* given = find_argument(tree, node, "scale", kByNameOnly);
  if (given != nullptr) {
    if (given->kind == ValueKind::kNumber) scale = Vec2(given->number);
    scale = pair_of(tree, *given).value_or(scale);
  }
  for (int axis = 0; axis < 2; ++axis) {
    scale[axis] = std::isfinite(scale[axis]) ? std::max(scale[axis], 0.0) : 1;
  }
  return scale;
}

}  // namespace

Rectangle read_square(const SyntaxTree& tree, const SyntaxNode& node, NodeProblems& problems) {
  Vec2 size(1.0);
  const Value* given = find_argument(tree, node, "size", 0);
  if (is_given(given)) {
    if (given->kind == ValueKind::kNumber) {
      size = Vec2(given->number);
    } else if (const std::optional<Vec2> pair = pair_of(tree, *given)) {
      size = *pair;
    } else {
      problems.add(node, {": Unable to convert square(size=" + printed(tree, *given) +
                              ", ...) parameter to a number or a vec2 of numbers",
                          "its size is 1"});
    }
  }
  const Value* center = find_argument(tree, node, "center", 1);
  const bool is_centered = center != nullptr && read_center(node, *center, problems);
  return is_centered ? Rectangle{-size / 2.0, size / 2.0} : Rectangle{Vec2(0.0), size};
}

Polygons read_polygon(const SyntaxTree& tree, const SyntaxNode& node, NodeProblems& problems) {
  std::optional<Polygon> points = read_points(tree, node, problems);
  if (!points) return {};
  const std::span<const Value> paths = list_argument(tree, node, "paths", 1, problems);
  Polygons result;
  if (paths.empty()) result.push_back(std::move(*points));
  ElementProblem beyond_points;
  for (size_t i = 0; i < paths.size(); ++i) {
    result.push_back(read_path(tree, *points, paths[i], i, beyond_points));
  }
  beyond_points.tell(node, problems);
  std::erase_if(result, [](const Polygon& polygon) { return polygon.size() < 3; });
  return result;
}

csgcore::FacetSettings read_facet_settings(const SyntaxTree& tree, const SyntaxNode& node) {
  const csgcore::FacetSettings defaults;
  return {number_argument(tree, node, "$fn").value_or(defaults.fn),
          number_argument(tree, node, "$fa").value_or(defaults.fa),
          number_argument(tree, node, "$fs").value_or(defaults.fs)};
}

OffsetArguments read_offset(const SyntaxTree& tree, const SyntaxNode& node) {
  OffsetArguments result;
  result.facets = read_facet_settings(tree, node);
  const std::optional<double> r = number_argument(tree, node, "r", 0);
  const std::optional<double> delta = number_argument(tree, node, "delta", 1);
  if (r) {
    result.distance = *r;
  } else if (delta) {
    result.distance = *delta;
    result.corners = is_true(find_argument(tree, node, "chamfer", 2)) ? CornerStyle::kSquare
                                                                      : CornerStyle::kSharp;
  }
  if (!std::isfinite(result.distance)) result.distance = 0;
  return result;
}

ResizeArguments read_resize(const SyntaxTree& tree, const SyntaxNode& node) {
  ResizeArguments result;
  const Value* size = find_argument(tree, node, "newsize", 0);
  if (size != nullptr && size->kind == ValueKind::kList) {
    const std::span<const Value> elements = tree.elements_of(*size);
    for (size_t i = 0; i < std::min(elements.size(), result.size.size()); ++i) {
      const bool is_number =
          elements[i].kind == ValueKind::kNumber && std::isfinite(elements[i].number);
      if (is_number) result.size[i] = elements[i].number;
    }
  }
  const Value* follows = find_argument(tree, node, "auto", 1);
  if (follows != nullptr && follows->kind == ValueKind::kList) {
    const std::span<const Value> elements = tree.elements_of(*follows);
    for (size_t i = 0; i < std::min(elements.size(), result.follows.size()); ++i) {
      result.follows[i] = is_on(elements[i]);
    }
  } else {
    result.follows.fill(is_true(follows));
  }
  return result;
}

bool read_cut(const SyntaxTree& tree, const SyntaxNode& node) {
  return is_true(find_argument(tree, node, "cut", 0));
}

csgcore::Vec3 ResizeArguments::factors(const csgcore::Vec3& box_size, int axes) const {
  csgcore::Vec3 result(1.0);
  size_t leading = 0;
  for (int axis = 0; axis < axes; ++axis) {
    const auto i = static_cast<size_t>(axis);
    if (size[i] > 0 && box_size[axis] > 0) result[axis] = size[i] / box_size[axis];
    if (size[i] > size[leading]) leading = i;
  }
  for (int axis = 0; axis < axes; ++axis) {
    const auto i = static_cast<size_t>(axis);
    if (size[i] <= 0 && follows[i]) result[axis] = result[static_cast<int>(leading)];
  }
  return result;
}

LinearExtrudeArguments read_linear_extrude(const SyntaxTree& tree, const SyntaxNode& node,
                                           NodeProblems& problems) {
  LinearExtrudeArguments result;
  result.facets = read_facet_settings(tree, node);
  read_height(tree, node, result);
  const Value* center = find_argument(tree, node, "center", kByNameOnly);
  result.is_centered = center != nullptr && read_center(node, *center, problems);
  const double twist = number_argument(tree, node, "twist").value_or(0);
  if (std::isfinite(twist)) result.twist = twist;
  result.top_scale = read_top_scale(tree, node);
  result.slices = count_argument(tree, node, "slices");
  result.segments = count_argument(tree, node, "segments");
  return result;
}

RotateExtrudeArguments read_rotate_extrude(const SyntaxTree& tree, const SyntaxNode& node) {
  RotateExtrudeArguments result;
  result.facets = read_facet_settings(tree, node);
  const std::optional<double> angle = number_argument(tree, node, "angle");
  if (angle && *angle > -360 && *angle <= 360) result.angle = *angle;
  result.start = number_argument(tree, node, "start");
  if (result.start && !std::isfinite(*result.start)) result.start.reset();
  return result;
}

}  // namespace frontend
