#include "section_plane.hpp"

#include <algorithm>
#include <vector>

#include "csgcore/polyhedron.hpp"

namespace window {
namespace {

using csgcore::Box;

/// The distance that the cut-off block reaches beyond the scene, as a share of the scene's size:
/// the plane is its only face near the scene.
constexpr double kMargin = 1;

/// Returns the block that is cut off; it is flat if the plane is beyond the margin.
Box cut_off_block(const SectionPlane& plane, const Box& bounds) {
  const csgcore::Vec3 margin(kMargin * bounds.diagonal());
  Box block{bounds.min - margin, bounds.max + margin};
  double& side = plane.is_flipped ? block.max[plane.axis] : block.min[plane.axis];
  side = std::clamp(plane.position, block.min[plane.axis], block.max[plane.axis]);
  return block;
}

}  // namespace

csgcore::Scene cut_open(const csgcore::Scene& scene, const SectionPlane& plane, const Box& bounds) {
  csgcore::Scene result = scene;
  if (bounds.empty()) return result;
  const Box block = cut_off_block(plane, bounds);
  if (!(block.min[plane.axis] < block.max[plane.axis])) return result;
  csgcore::Primitive cut = csgcore::make_polyhedron(csgcore::Polyhedron::box(block));
  cut.id = kSectionId;
  const auto index = static_cast<uint32_t>(result.primitives.size());
  result.primitives.push_back(std::move(cut));
  result.model = csgcore::subtract(result.model, index);
  for (csgcore::Layer& layer : result.layers) {
    layer.solid = csgcore::subtract(layer.solid, index);
    layer.parts.clear();  // they would show beyond the plane
  }
  return result;
}

std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains) {
  using Found = std::optional<uint32_t>;
  std::vector<Found> operands;  // of the operations that are not complete
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      operands.push_back(contains(token.value) ? Found(token.value) : std::nullopt);
      continue;
    }
    const auto first = operands.end() - token.value;
    const auto is_solid = [](const Found& operand) { return operand.has_value(); };
    Found result = *first;
    switch (token.op) {
      case csgcore::Op::kUnion:
        if (const auto any = std::find_if(first, operands.end(), is_solid); any != operands.end()) {
          result = *any;
        }
        break;
      case csgcore::Op::kIntersection:
        if (!std::all_of(first, operands.end(), is_solid)) result.reset();
        break;
      case csgcore::Op::kDifference:
        if (std::any_of(first + 1, operands.end(), is_solid)) result.reset();
        break;
    }
    operands.erase(first, operands.end());
    operands.push_back(result);
  }
  return operands.empty() ? std::nullopt : operands.front();
}

}  // namespace window
