// Set operations on plane figures that come from solids.
#pragma once

#include <optional>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "plane/figure.hpp"

namespace frontend {

struct FigureOperations {
  std::vector<Figure> figures;
  csgcore::CsgTree tree;  // over the indices of some of them

  bool is_empty() const { return tree.empty(); }
};

FigureOperations union_of(std::vector<Figure> figures);
/// Returns the union of all.
FigureOperations union_of(std::vector<FigureOperations> operands);

/// Returns figures whose union is the outcome; nothing if their edges cross too often
/// (kMostCrossings).
std::optional<std::vector<Figure>> outcome_of(const FigureOperations& operations);

}  // namespace frontend
