#include <algorithm>
#include <bit>
#include <utility>

#include "hulls/point_hull.hpp"
#include "plane/hull.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

std::optional<std::vector<Figure>> hull_of_figures(SubtreeEvaluation& evaluation, uint32_t node) {
  std::vector<Disc> discs;
  for (const Figure& figure : evaluation.figures_of_operands(node)) add_hull_points(figure, discs);
  return std::vector<Figure>{convex_hull(discs)};
}

/// Bodies of fewer generators are copied, so that generators are in the order of the design:
/// rounding may follow it.
constexpr size_t kManyGenerators = 4096;

/// So few points need not be looked at: to move them takes less.
constexpr size_t kFewPoints = 512;

/// Leaves out points that are no corners of the hull, in the order of the others.
void keep_corners(Generators& generators) {
  std::vector<csgcore::Vec3> points;
  for (const Generator& generator : generators) {
    if (generator.has_disc() || generator.has_ball() || !is_finite(generator)) return;
    points.push_back(generator.center);
  }
  const PointHull hull = point_hull(on_grid(points));
  if (hull.dimension < 3) return;
  Generators corners;
  for (const uint32_t corner : hull.corners) corners.push_back(generators[corner]);
  generators = std::move(corners);
}

/// Returns the operand that is one body of many generators, the largest of several; null: none is.
SolidPart* largest_body(std::vector<SolidValue>& operands) {
  SolidPart* largest = nullptr;
  size_t most = kManyGenerators;
  for (SolidValue& operand : operands) {
    if (operand.parts.size() != 1 || !operand.is_union()) continue;
    SolidPart& part = operand.parts.front();
    if (part.primitive || part.body.generators.size() <= most) continue;
    largest = &part;
    most = part.body.generators.size();
  }
  return largest;
}

SolidValue hull_of_solids(SubtreeEvaluation& evaluation, uint32_t node) {
  SupportSet support;
  csgcore::Box box;
  size_t most_before = 0;  // generators of a hull within
  const auto add = [&](const SolidPart& part) {
    most_before = std::max(most_before, part.body.generators.size());
    part.add_support(support);
    box.merge(part.box);
  };
  std::vector<SolidValue> all = evaluation.solids_of_operands(node);
  // The largest body is added to: a chain of hulls within hulls copies none at each of them.
  SolidPart* const largest = largest_body(all);
  if (largest != nullptr) {
    most_before = largest->body.generators.size();
    support = std::exchange(largest->body, {});
    box.merge(largest->box);
  }
  for (const SolidValue& operand : all) {
    if (largest != nullptr && operand.parts.data() == largest) continue;
    for (const SolidPart& part : evaluation.united(operand)) add(part);
  }
  if (support.generators.empty()) return {};
  // Now and then, so that a chain of hulls has no more points than the last of them.
  const bool has_doubled = std::bit_width(support.generators.size()) > std::bit_width(most_before);
  if (most_before > kFewPoints && has_doubled) keep_corners(support.generators);
  return value_of(part_of(std::move(support), box));
}

}  // namespace

const NodeRow kHullRow{
    .role = Role::kWhole,
    .joins_figures = true,
    .inner_parts = InnerParts::kOwn,
    .figures = hull_of_figures,
    .solid = hull_of_solids,
};

}  // namespace frontend
