// What the nodes of a subtree of solids yield that OpenSCAD evaluates as a whole.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/geometry_dialect.hpp"
#include "solids/figure_operations.hpp"
#include "solids/figure_solids.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_shape.hpp"
#include "solids/solid_union.hpp"
#include "solids/solid_value.hpp"
#include "subtrees/plane_evaluation.hpp"
#include "subtrees/subtree.hpp"

namespace frontend {

class SolidEvaluation {
 public:
  SolidEvaluation(const PlaneSubtree& subtree, const PlaneEvaluation& planes,
                  const ImportOptions& options, SolidSources sources, FigureSolids& figure_solids,
                  SolidPool& pool, NodeProblems& problems)
      : subtree_(subtree),
        planes_(planes),
        options_(options),
        sources_(sources),
        figure_solids_(figure_solids),
        pool_(pool),
        problems_(problems),
        keeps_colors_(GeometryDialect(options.language).keeps_colors) {}

  /// Returns the root's solid in its own coordinates: a union, or what resize() has of a tree.
  /// Nothing if it cannot be found: failure() says why.
  std::optional<SolidValue> run() { return run(subtree_.root()); }
  /// Returns the figures of a projection node, likewise. Its descendants' presence is known.
  std::optional<FigureOperations> projection(uint32_t node);
  std::string_view failure() const { return failure_; }

  // For the rows of nodes:
  template <typename Data>
  const Data& data(uint32_t node) const {
    return subtree_.data<Data>(node);
  }
  /// Returns the values of the operands that count, in their order; the nodes lose them.
  std::vector<SolidValue> operands(uint32_t node);
  /// Returns parts whose union is the value, as far as that can be found (SolidUnion).
  std::vector<SolidPart> united(const SolidValue& value, int least_chords = kChordsOfCutDisc);
  SolidPool& pool() { return pool_; }
  /// GeometryDialect::keeps_colors.
  bool keeps_colors() const { return keeps_colors_; }
  /// Nothing more is evaluated.
  void fail(std::string_view why);

 private:
  std::optional<SolidValue> run(uint32_t root);
  std::vector<uint32_t> solid_nodes(uint32_t root) const;
  std::optional<FigureOperations> section(uint32_t node, const SolidValue& value);
  std::optional<FigureOperations> shadow(const SolidValue& value);
  SolidValue evaluate(uint32_t node);
  SolidValue solid_of_leaf(uint32_t node);
  SolidValue solid_of_extrusion(uint32_t node);

  const PlaneSubtree& subtree_;
  const PlaneEvaluation& planes_;
  const ImportOptions& options_;
  SolidSources sources_;
  FigureSolids& figure_solids_;
  SolidPool& pool_;
  NodeProblems& problems_;
  const bool keeps_colors_;
  uint32_t first_ = 0;              // the root of what is evaluated
  std::vector<SolidValue> values_;  // by node from that; one is moved to the node around it
  std::string_view failure_;
};

}  // namespace frontend
