#include "subtrees/solid_evaluation.hpp"

#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/stop_scope.hpp"
#include "solids/leaves.hpp"
#include "solids/sections.hpp"
#include "solids/shadows.hpp"
#include "subtrees/extrusions.hpp"

namespace frontend {

std::optional<SolidValue> SolidEvaluation::run(uint32_t root) {
  first_ = root;
  values_.assign(subtree_.end_of(root) - root, {});
  // Children come after their parents: from the last node on, all that a node holds is known.
  const std::vector<uint32_t> nodes = solid_nodes(root);
  for (auto node = nodes.rbegin(); node != nodes.rend() && failure_.empty(); ++node) {
    csgcore::stop_point();
    values_[*node - root] = evaluate(*node);
  }
  if (!failure_.empty()) return std::nullopt;
  return std::move(values_.front());
}

/// Returns the root, and the nodes of solids below it without those of other projections, whose
/// figures are known.
std::vector<uint32_t> SolidEvaluation::solid_nodes(uint32_t root) const {
  std::vector<uint32_t> result{root};
  for (uint32_t i = root + 1; i < subtree_.end_of(root);) {
    if (subtree_.syntax(i).kind == NodeKind::kProjection) {
      i = subtree_.end_of(i);
      continue;
    }
    if (planes_.presence(i) == Presence::kSolid && planes_.dimension(i) == 3) result.push_back(i);
    ++i;
  }
  return result;
}

std::optional<FigureOperations> SolidEvaluation::projection(uint32_t node) {
  const std::optional<SolidValue> value = run(node);
  if (!value) return std::nullopt;
  if (value->is_empty()) return FigureOperations{};
  return subtree_.data<ProjectionNode>(node).is_cut ? section(node, *value) : shadow(*value);
}

std::optional<FigureOperations> SolidEvaluation::section(uint32_t node, const SolidValue& value) {
  Section section = section_of(value);
  if (section.has_open_mesh) {
    problems_.add(subtree_.syntax(node),
                  {": The given mesh is not closed", "it has no section: close it"});
  } else if (section.operations.is_empty()) {
    problems_.add(subtree_.syntax(node),
                  {": Projection() failed", "nothing meets the plane z = 0"});
  }
  return std::move(section.operations);
}

std::optional<FigureOperations> SolidEvaluation::shadow(const SolidValue& value) {
  Shadows shadows(pool_);
  std::optional<FigureOperations> result = shadows.of(value);
  if (!result) fail(shadows.failure());
  return result;
}

void SolidEvaluation::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

std::vector<SolidValue> SolidEvaluation::operands(uint32_t node) {
  std::vector<SolidValue> result;
  planes_.visit_operands(node, [&](uint32_t child) {
    if (planes_.presence(child) == Presence::kLeftOut) return;
    result.push_back(std::move(values_[child - first_]));
  });
  return result;
}

SolidValue SolidEvaluation::evaluate(uint32_t node) {
  const NodeRow& row = subtree_.row(node);
  if (row.role == Role::kSolid) return solid_of_leaf(node);
  if (row.extruded != nullptr) return solid_of_extrusion(node);
  return row.solid == nullptr ? combined(row.op, operands(node)) : row.solid(*this, node);
}

SolidValue SolidEvaluation::solid_of_leaf(uint32_t node) {
  std::optional<SolidShape> shape =
      solid_shape(subtree_.data(node), subtree_.syntax(node), sources_, problems_);
  if (!shape || (shape->faces != nullptr && shape->faces->is_empty())) return {};
  SolidPart part = part_of(shape->primitive, shape->facets);
  const int fragments =
      keeps_facets(options_, shape->facets)
          ? traits_of(shape->primitive.shape()).fragments(shape->primitive, shape->facets)
          : 0;
  if (fragments > 0 && sources_.polyhedra.facet(shape->primitive, fragments)) {
    part.primitive = std::move(shape->primitive);
  }
  if (keeps_colors_) part.color = shape->color;
  return value_of(std::move(part));
}

SolidValue SolidEvaluation::solid_of_extrusion(uint32_t node) {
  FrameTree frames;
  FigureTree figures = figure_tree(subtree_, planes_, node, 0, frames);
  if (figures.figures.empty()) return {};
  const std::vector<Figure> outcome = planes_.union_of_operands(node);
  // What is needed is the surface: operations are done in the plane.
  if (!is_union(figures.tree)) figures = union_of(outcome, 0, subtree_.id(node));
  LoweredSubtree lowered =
      subtree_.row(node).extruded({subtree_.syntax(node), subtree_.data(node), figures,
                                   [&] { return std::span<const Figure>(outcome); }, 0, frames,
                                   figure_solids_, problems_, true});
  SolidValue result{{}, std::move(lowered.solid)};
  for (LoweredSubtree::Part& part : lowered.parts) {
    SolidPart& own = result.parts.emplace_back();
    own.primitive = std::move(part.primitive);
    own.facets = part.facets;
    own.is_faceted = lowered.is_faceted;
    own.box = part.box;
  }
  return result;
}

std::vector<SolidPart> SolidEvaluation::united(const SolidValue& value, int least_chords) {
  SolidUnion outcome(pool_, least_chords);
  std::vector<SolidPart> parts = outcome.parts_of(value);
  if (!outcome.failure().empty()) fail(outcome.failure());
  return parts;
}

}  // namespace frontend
