#include <algorithm>
#include <cmath>

#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kResizeLabel[] = {"newsize"};

/// An element of a list of switches, which OpenSCAD writes as numbers.
bool is_on(const ArgumentValue& value) {
  return value.is_true() || (value.is_number() && value.number() != 0);
}

ResizeArguments read_resize(NodeReader& reader) {
  ResizeArguments result;
  const ArgumentValue size = reader.find("newsize", 0);
  if (size.is_list()) {
    const ValueList elements = size.elements();
    for (size_t i = 0; i < std::min(elements.size(), result.size.size()); ++i) {
      const bool is_number = elements[i].is_number() && std::isfinite(elements[i].number());
      if (is_number) result.size[i] = elements[i].number();
    }
  }
  const ArgumentValue follows = reader.find("auto", 1);
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

/// Returns the factors by which a box of that size is scaled, of the first `axes` axes; those of
/// others are 1.
csgcore::Vec3 factors_of(const ResizeArguments& arguments, const csgcore::Vec3& box_size,
                         int axes) {
  const auto& [size, follows] = arguments;
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

std::optional<std::vector<Figure>> resized_figures(SubtreeEvaluation& evaluation, uint32_t node) {
  std::vector<Figure> figures = evaluation.figures_of_operands(node);
  Rectangle box;
  for (const Figure& figure : figures) box.merge(bounds_of(figure));
  PlaneMap map;
  if (!box.empty()) {
    const csgcore::Vec3 factor =
        factors_of(evaluation.data<ResizeArguments>(node), csgcore::Vec3(box.max - box.min, 0), 2);
    map.linear = glm::dmat2(factor.x, 0, 0, factor.y);
  }
  evaluation.set_map(node, map);
  return evaluation.moved(std::move(figures), node);
}

/// What is round has OpenSCAD's chords.
constexpr int kChordsOfOpenScad = 0;

SolidValue resized_solid(SubtreeEvaluation& evaluation, uint32_t node) {
  SolidValue result = combined(csgcore::Op::kUnion, evaluation.solids_of_operands(node));
  if (result.is_empty()) return {};
  csgcore::Box box;
  for (const SolidPart& part : evaluation.united(result, kChordsOfOpenScad)) box.merge(part.box);
  if (box.empty()) return {};
  const csgcore::Vec3 factors = factors_of(evaluation.data<ResizeArguments>(node), box.size(), 3);
  csgcore::Affine map;
  for (int axis = 0; axis < 3; ++axis) map.linear[axis][axis] = factors[axis];
  for (SolidPart& part : result.parts) part.map(map);
  return result;
}

}  // namespace

const NodeRow kResizeRow{
    .role = Role::kWhole,
    .joins_figures = true,
    .inner_parts = InnerParts::kOwn,
    .label = kResizeLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_resize(reader); },
    .figures = resized_figures,
    .solid = resized_solid,
};

}  // namespace frontend
