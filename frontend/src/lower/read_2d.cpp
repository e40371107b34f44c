#include "lower/read_2d.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lower/argument_lookup.hpp"

namespace frontend {
namespace {

/// The value as OpenSCAD prints it.
std::string printed(const ArgumentValue& value) {
  if (value.is_string()) return '"' + std::string(value.text()) + '"';
  if (!value.is_list()) return scalar_text(value);
  std::string text = "[";
  for (const ArgumentValue element : value.elements()) {
    if (text.size() > 1) text += ", ";
    // No point holds lists; what is deeper does not matter.
    text += element.is_list() ? "[...]" : printed(element);
  }
  return text + "]";
}

std::optional<Vec2> pair_of(const ArgumentValue& value) {
  if (!value.is_list()) return std::nullopt;
  const ValueList elements = value.elements();
  if (elements.size() != 2 || !elements[0].is_number() || !elements[1].is_number()) {
    return std::nullopt;
  }
  return Vec2(elements[0].number(), elements[1].number());
}

/// An element of a list of switches, which OpenSCAD writes as numbers.
bool is_on(const ArgumentValue& value) {
  return value.is_true() || (value.is_number() && value.number() != 0);
}

/// The points; nothing if one of them is none.
std::optional<Polygon> read_points(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  const ValueList values = list_argument(tree, node, "points", 0, problems);
  Polygon points;
  points.reserve(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const std::optional<Vec2> point = pair_of(values[i]);
    if (!point || std::isinf(point->x) || std::isinf(point->y)) {
      problems.add(node, {": Unable to convert points[" + std::to_string(i) +
                              "] = " + printed(values[i]) + " to a vec2 of numbers",
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
uint32_t index_of(const ArgumentValue& value) {
  if (!value.is_number() || !std::isfinite(value.number())) return 0;
  constexpr double kLargest = 4294967296.0;  // 2^32
  const double number = std::trunc(value.number());
  if (number >= kLargest || number <= -kLargest) return 0xFFFFFFFFu;
  return static_cast<uint32_t>(static_cast<int64_t>(number));
}

Polygon read_path(const Polygon& points, const ArgumentValue& path, size_t path_index,
                  ElementProblem& beyond_points) {
  Polygon result;
  if (!path.is_list()) return result;
  const ValueList indices = path.elements();
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
std::optional<double> count_argument(const NodeTree& tree, const Node& node,
                                     language::ArgumentName name) {
  const std::optional<double> value = number_argument(tree, node, name);
  if (!value || !(*value >= 1) || !std::isfinite(*value)) return std::nullopt;
  return std::trunc(*value);
}

/// Three finite numbers.
std::optional<std::array<double, 3>> triple_of(const ArgumentValue& value) {
  if (!value.is_list() || value.elements().size() != 3) return std::nullopt;
  std::array<double, 3> result{};
  for (size_t i = 0; i < result.size(); ++i) {
    const ArgumentValue element = value.elements()[i];
    if (!element.is_number() || !std::isfinite(element.number())) return std::nullopt;
    result[i] = element.number();
  }
  return result;
}

/// Height and direction. A direction alone is as long as the extrusion; with a height it is the
/// direction only.
void read_height(const NodeTree& tree, const Node& node, LinearExtrudeArguments& result) {
  std::optional<double> height = number_argument(tree, node, "height", 0);
  if (!height) height = number_argument(tree, node, "h");
  if (height && std::isfinite(*height)) result.height = *height;
  const auto direction = triple_of(find_argument(tree, node, "v"));
  if (!direction) return;
  const auto [x, y, z] = *direction;
  const double length = std::hypot(x, y, z);
  const double share = height && length > 0 ? result.height / length : 1;
  result.height = share * z;
  result.lean = share * Vec2(x, y);
}

Vec2 read_top_scale(const NodeTree& tree, const Node& node) {
  Vec2 scale(1.0);
  const ArgumentValue given = find_argument(tree, node, "scale");
  if (given.is_number()) scale = Vec2(given.number());
  scale = pair_of(given).value_or(scale);
  for (int axis = 0; axis < 2; ++axis) {
    scale[axis] = std::isfinite(scale[axis]) ? std::max(scale[axis], 0.0) : 1;
  }
  return scale;
}

}  // namespace

Rectangle read_square(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  Vec2 size(1.0);
  const ArgumentValue given = find_argument(tree, node, "size", 0);
  if (!given.is_undef()) {
    if (given.is_number()) {
      size = Vec2(given.number());
    } else if (const std::optional<Vec2> pair = pair_of(given)) {
      size = *pair;
    } else {
      problems.add(node, {": Unable to convert square(size=" + printed(given) +
                              ", ...) parameter to a number or a vec2 of numbers",
                          "its size is 1"});
    }
  }
  const ArgumentValue center = find_argument(tree, node, "center", 1);
  const bool is_centered = read_center(node, center, problems);
  return is_centered ? Rectangle{-size / 2.0, size / 2.0} : Rectangle{Vec2(0.0), size};
}

Polygons read_polygon(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  std::optional<Polygon> points = read_points(tree, node, problems);
  if (!points) return {};
  const ValueList paths = list_argument(tree, node, "paths", 1, problems);
  Polygons result;
  if (paths.empty()) result.push_back(std::move(*points));
  ElementProblem beyond_points;
  for (size_t i = 0; i < paths.size(); ++i) {
    result.push_back(read_path(*points, paths[i], i, beyond_points));
  }
  beyond_points.tell(node, problems);
  std::erase_if(result, [](const Polygon& polygon) { return polygon.size() < 3; });
  return result;
}

csgcore::FacetSettings read_facet_settings(const NodeTree& tree, const Node& node) {
  const csgcore::FacetSettings defaults;
  return {number_argument(tree, node, "$fn").value_or(defaults.fn),
          number_argument(tree, node, "$fa").value_or(defaults.fa),
          number_argument(tree, node, "$fs").value_or(defaults.fs)};
}

OffsetArguments read_offset(const NodeTree& tree, const Node& node) {
  OffsetArguments result;
  result.facets = read_facet_settings(tree, node);
  const std::optional<double> r = number_argument(tree, node, "r", 0);
  const std::optional<double> delta = number_argument(tree, node, "delta", 1);
  if (r) {
    result.distance = *r;
  } else if (delta) {
    result.distance = *delta;
    result.corners = find_argument(tree, node, "chamfer", 2).is_true() ? CornerStyle::kSquare
                                                                       : CornerStyle::kSharp;
  }
  if (!std::isfinite(result.distance)) result.distance = 0;
  return result;
}

ResizeArguments read_resize(const NodeTree& tree, const Node& node) {
  ResizeArguments result;
  const ArgumentValue size = find_argument(tree, node, "newsize", 0);
  if (size.is_list()) {
    const ValueList elements = size.elements();
    for (size_t i = 0; i < std::min(elements.size(), result.size.size()); ++i) {
      const bool is_number = elements[i].is_number() && std::isfinite(elements[i].number());
      if (is_number) result.size[i] = elements[i].number();
    }
  }
  const ArgumentValue follows = find_argument(tree, node, "auto", 1);
  if (follows.is_list()) {
    const ValueList elements = follows.elements();
    for (size_t i = 0; i < std::min(elements.size(), result.follows.size()); ++i) {
      result.follows[i] = is_on(elements[i]);
    }
  } else {
    result.follows.fill(follows.is_true());
  }
  return result;
}

bool read_cut(const NodeTree& tree, const Node& node) {
  return find_argument(tree, node, "cut", 0).is_true();
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

LinearExtrudeArguments read_linear_extrude(const NodeTree& tree, const Node& node,
                                           NodeProblems& problems) {
  LinearExtrudeArguments result;
  result.facets = read_facet_settings(tree, node);
  read_height(tree, node, result);
  result.is_centered = read_center(node, find_argument(tree, node, "center"), problems);
  const double twist = number_argument(tree, node, "twist").value_or(0);
  if (std::isfinite(twist)) result.twist = twist;
  result.top_scale = read_top_scale(tree, node);
  result.slices = count_argument(tree, node, "slices");
  result.segments = count_argument(tree, node, "segments");
  return result;
}

RotateExtrudeArguments read_rotate_extrude(const NodeTree& tree, const Node& node) {
  RotateExtrudeArguments result;
  result.facets = read_facet_settings(tree, node);
  const std::optional<double> angle = number_argument(tree, node, "angle");
  if (angle && *angle > -360 && *angle <= 360) result.angle = *angle;
  result.start = number_argument(tree, node, "start");
  if (result.start && !std::isfinite(*result.start)) result.start.reset();
  return result;
}

}  // namespace frontend
