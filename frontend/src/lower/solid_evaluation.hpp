// What the nodes of a subtree of solids yield that OpenSCAD evaluates as a whole.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lower/figure_operations.hpp"
#include "lower/figure_solids.hpp"
#include "lower/import_files.hpp"
#include "lower/import_polyhedra.hpp"
#include "lower/plane_evaluation.hpp"
#include "lower/plane_subtree.hpp"
#include "lower/revolved_solid.hpp"
#include "lower/solid_value.hpp"

namespace frontend {

class SolidEvaluation {
 public:
  /// What makes and reads the solids of a design.
  struct Sources {
    PolyhedronPool& polyhedra;
    FileImports& files;
    FigureSolids& figures;
  };

  SolidEvaluation(const PlaneSubtree& subtree, const PlaneEvaluation& planes,
                  const ImportOptions& options, Sources sources, NodeProblems& problems)
      : subtree_(subtree),
        planes_(planes),
        options_(options),
        sources_(sources),
        problems_(problems) {}

  /// Returns the root's solid in its own coordinates: a union, or what resize() has of a tree.
  /// Nothing if it cannot be found: failure() says why.
  std::optional<SolidValue> run() { return run(subtree_.root()); }
  /// Returns the figures of a projection node, likewise. Its descendants' presence is known.
  std::optional<FigureOperations> projection(uint32_t node);
  std::string_view failure() const { return failure_; }

 private:
  std::optional<SolidValue> run(uint32_t root);
  std::vector<uint32_t> solid_nodes(uint32_t root) const;
  std::optional<FigureOperations> section(uint32_t node, const SolidValue& value);
  std::optional<FigureOperations> shadow(const SolidValue& value);
  SolidValue evaluate(uint32_t node);
  SolidValue solid_of_leaf(uint32_t node);
  SolidValue solid_of_faces(const SolidOfFaces* solid);
  const SolidOfFaces* solid_of_file(uint32_t node);
  SolidValue round_solid(const RoundNode& round);
  SolidValue extruded(uint32_t node);
  SolidValue revolved(uint32_t node);
  SolidValue revolved_in(const TurnSections& sections, std::optional<SimplePolygons> outline,
                         bool is_left, bool is_smooth);
  SolidValue hull(uint32_t node);
  SolidValue minkowski(uint32_t node);
  SolidValue resized(uint32_t node);
  std::vector<SolidPart> united(const SolidValue& value);
  std::vector<SolidPart> sum(const std::vector<SolidPart>& a, const std::vector<SolidPart>& b);
  std::vector<SolidValue> operands(uint32_t node);
  void fail(std::string_view why);

  const PlaneSubtree& subtree_;
  const PlaneEvaluation& planes_;
  const ImportOptions& options_;
  Sources sources_;
  NodeProblems& problems_;
  uint32_t first_ = 0;              // the root of what is evaluated
  std::vector<SolidValue> values_;  // by node from that; one is moved to the node around it
  std::string_view failure_;
};

}  // namespace frontend
