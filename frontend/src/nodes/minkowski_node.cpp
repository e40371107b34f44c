#include <algorithm>
#include <utility>

#include "solids/solid_sums.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/plane_evaluation.hpp"
#include "subtrees/solid_evaluation.hpp"

namespace frontend {
namespace {

std::optional<std::vector<Figure>> sum_of_figures(PlaneEvaluation& planes, uint32_t node) {
  std::optional<std::vector<Figure>> sum;
  bool is_first = true;
  planes.visit_operands(node, [&](uint32_t child) {
    const std::vector<Figure>& operand = planes.figures(child);
    if (is_first) {
      sum = operand;
      is_first = false;
    } else if (sum && planes.presence(child) == Presence::kSolid) {
      sum = minkowski_sum(*sum, operand);
    }
  });
  return sum;
}

std::vector<SolidPart> sum(SolidEvaluation& solids, std::vector<SolidPart> a,
                           std::vector<SolidPart> b) {
  SolidSums sums;
  sums.add(std::move(a), std::move(b));
  if (!sums.failure().empty()) solids.fail(sums.failure());
  return sums.take();
}

SolidValue sum_of_solids(SolidEvaluation& solids, uint32_t node) {
  std::vector<SolidValue> all = solids.operands(node);
  std::erase_if(all, [](const SolidValue& value) { return value.is_empty(); });
  if (all.empty()) return {};
  if (all.size() == 1) return std::move(all.front());
  std::vector<SolidPart> result;
  for (const SolidValue& operand : all) {
    // OpenSCAD ignores what is empty.
    std::vector<SolidPart> parts = solids.united(operand);
    if (!solids.failure().empty()) return {};
    if (parts.empty()) continue;
    if (result.empty()) {
      result = std::move(parts);
      continue;
    }
    // As in OpenSCAD, nothing is left where a sum is flat, whatever comes after it.
    result = sum(solids, std::move(result), std::move(parts));
    if (result.empty()) return {};
  }
  return union_of(std::move(result));
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
