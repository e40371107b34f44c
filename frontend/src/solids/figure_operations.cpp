#include "solids/figure_operations.hpp"

#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

#include "plane/outlines.hpp"
#include "solids/leaves.hpp"

namespace frontend {

using csgcore::CsgToken;
using csgcore::CsgTreeBuilder;

namespace {

/// Returns the figures that the tree names.
std::vector<Figure> figures_of(const FigureOperations& operations) {
  std::vector<Figure> result;
  for (const CsgToken& token : operations.tree.tokens()) {
    if (token.is_primitive) result.push_back(operations.figures[token.value]);
  }
  return result;
}

}  // namespace

FigureOperations union_of(std::vector<Figure> figures) {
  CsgTreeBuilder builder;
  for (uint32_t i = 0; i < figures.size(); ++i) builder.primitive(i);
  return {std::move(figures), builder.finish()};
}

FigureOperations union_of(std::vector<FigureOperations> operands) {
  FigureOperations result;
  CsgTreeBuilder builder;
  for (FigureOperations& operand : operands) {
    const auto first = static_cast<uint32_t>(result.figures.size());
    rebuild(operand.tree.tokens(), builder,
            [first](CsgTreeBuilder& to, uint32_t figure) { to.primitive(first + figure); });
    result.figures.insert(result.figures.end(), std::make_move_iterator(operand.figures.begin()),
                          std::make_move_iterator(operand.figures.end()));
  }
  result.tree = builder.finish();
  return result;
}

std::optional<std::vector<Figure>> outcome_of(const FigureOperations& operations) {
  if (is_union(operations.tree)) return figures_of(operations);
  std::vector<SimplePolygons> done;  // of the subtrees that no operation has taken
  for (const CsgToken& token : operations.tree.tokens()) {
    std::optional<SimplePolygons> polygons;
    if (token.is_primitive) {
      polygons = united(std::span(&operations.figures[token.value], 1));
    } else {
      const auto first = done.end() - static_cast<std::ptrdiff_t>(token.value);
      polygons = combined(token.op, std::span(first, done.end()));
      done.erase(first, done.end());
    }
    if (!polygons) return std::nullopt;
    done.push_back(std::move(*polygons));
  }
  std::vector<Figure> result;
  if (!done.back().empty()) result.push_back(outline_of(std::move(done.back())));
  return result;
}

}  // namespace frontend
