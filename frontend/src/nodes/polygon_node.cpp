#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "arguments/value_text.hpp"
#include "plane/outlines.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

/// The points; nothing if one of them is none.
std::optional<Polygon> read_points(NodeReader& reader) {
  const ValueList values = reader.list("points", 0);
  Polygon points;
  points.reserve(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const std::optional<Vec2> point = pair_of(values[i]);
    if (!point || std::isinf(point->x) || std::isinf(point->y)) {
      reader.tell({": Unable to convert points[" + std::to_string(i) +
                       "] = " + printed_text(values[i]) + " to a vec2 of numbers",
                   "it is left out"});
      return std::nullopt;
    }
    if (std::isnan(point->x) || std::isnan(point->y)) {
      reader.tell({": Range check failed", "it is left out"});
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

/// The paths, all of finite points, filled by the even-odd rule.
Polygons read_paths(NodeReader& reader) {
  std::optional<Polygon> points = read_points(reader);
  if (!points) return {};
  const ValueList paths = reader.list("paths", 1);
  Polygons result;
  if (paths.empty()) result.push_back(std::move(*points));
  ElementProblem beyond_points;
  for (size_t i = 0; i < paths.size(); ++i) {
    result.push_back(read_path(*points, paths[i], i, beyond_points));
  }
  reader.tell_first(beyond_points);
  std::erase_if(result, [](const Polygon& polygon) { return polygon.size() < 3; });
  return result;
}

}  // namespace

const NodeRow kPolygonRow{
    .role = Role::kWhole,
    .dimension = 2,
    .counted = "points",
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData {
      return FigureNode{cleaned(outline_of(read_paths(reader)))};
    },
};

}  // namespace frontend
