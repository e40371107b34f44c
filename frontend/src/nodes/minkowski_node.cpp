#include <string_view>
#include <utility>

#include "solids/solid_sums.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

std::optional<std::vector<Figure>> sum_of_figures(SubtreeEvaluation& evaluation, uint32_t node) {
  std::optional<std::vector<Figure>> sum;
  bool is_first = true;
  evaluation.visit_operands(node, [&](uint32_t child) {
    const std::vector<Figure>& operand = evaluation.figures(child);
    if (is_first) {
      sum = operand;
      is_first = false;
    } else if (sum && evaluation.presence(child) == Presence::kSolid) {
      sum = minkowski_sum(*sum, operand);
    }
  });
  return sum;
}

/// The sum of solids, or why there is none.
struct SolidSum {
  std::vector<SolidPart> parts;
  std::string_view failure;
};

SolidSum sum_of(SubtreeEvaluation& evaluation, const std::vector<SolidValue>& operands,
                int chords) {
  SolidSum result;
  for (const SolidValue& operand : operands) {
    std::vector<SolidPart> parts = evaluation.united(operand, chords);
    if (!evaluation.failure().empty()) return {};
    // OpenSCAD ignores what is empty.
    if (parts.empty()) continue;
    if (result.parts.empty()) {
      result.parts = std::move(parts);
      continue;
    }
    SolidSums sums(evaluation.sources().pool, chords);
    sums.add(std::move(result.parts), std::move(parts));
    result = {sums.take(), sums.failure()};
    // As in OpenSCAD, nothing is left where a sum is flat, whatever comes after it.
    if (result.parts.empty() || !result.failure.empty()) break;
  }
  return result;
}

SolidValue sum_of_solids(SubtreeEvaluation& evaluation, uint32_t node) {
  std::vector<SolidValue> all = evaluation.solids_of_operands(node);
  std::erase_if(all, [](const SolidValue& value) { return value.is_empty(); });
  if (all.empty()) return {};
  if (all.size() == 1) return std::move(all.front());
  // Curved solids that are not convex are added in few facets where many take too long.
  SolidSum result;
  for (const int chords : {kChordsOfCutDisc, kChordsOfCutDisc / 3}) {
    result = sum_of(evaluation, all, chords);
    for (SolidPart& part : result.parts) part.color.reset();
    if (result.failure.empty()) return union_of(std::move(result.parts));
  }
  evaluation.fail(result.failure);
  return {};
}

}  // namespace

const NodeRow kMinkowskiRow{
    .role = Role::kWhole,
    .joins_figures = true,
    .inner_parts = InnerParts::kOwn,
    .figures = sum_of_figures,
    .solid = sum_of_solids,
};

}  // namespace frontend
