#include <cmath>
#include <string>

#include "arguments/value_text.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kSquareLabel[] = {"size"};

/// It may be empty, flat or infinite.
Rectangle read_rectangle(NodeReader& reader) {
  Vec2 size(1.0);
  const ArgumentValue given = reader.find("size", 0);
  if (!given.is_undef()) {
    if (given.is_number()) {
      size = Vec2(given.number());
    } else if (const std::optional<Vec2> pair = pair_of(given)) {
      size = *pair;
    } else {
      reader.tell({": Unable to convert square(size=" + printed_text(given) +
                       ", ...) parameter to a number or a vec2 of numbers",
                   "its size is 1"});
    }
  }
  const bool is_centered = reader.center(1);
  return is_centered ? Rectangle{-size / 2.0, size / 2.0} : Rectangle{Vec2(0.0), size};
}

FigureNode read_square(NodeReader& reader) {
  const Rectangle box = read_rectangle(reader);
  const Vec2 size = box.max - box.min;
  FigureNode result;
  if (!(size.x > 0 && size.y > 0 && std::isfinite(size.x) && std::isfinite(size.y))) return result;
  result.figure =
      outline_of(Polygons{{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}});
  return result;
}

}  // namespace

const NodeRow kSquareRow{
    .role = Role::kWhole,
    .dimension = 2,
    .label = kSquareLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_square(reader); },
};

}  // namespace frontend
