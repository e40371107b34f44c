// What the nodes of a 2D subtree yield: which are empty, which OpenSCAD ignores, and their figures.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "heal/matrix_healing.hpp"
#include "plane/figure.hpp"
#include "plane/outlines.hpp"
#include "plane/plane_map.hpp"
#include "solids/figure_operations.hpp"
#include "subtrees/subtree.hpp"

namespace frontend {

/// What a node is as an operand.
enum class Presence : uint8_t {
  kAbsent,      // nothing: disabled, or outside the subtree that `!` selects
  kBackground,  // `%`, or nothing but `%` parts: no operand
  kLeftOut,     // what cannot be drawn was left out, and nothing else is there: no operand
  kEmpty,       // the empty set
  kSolid,
};

class PlaneEvaluation {
 public:
  /// Is told of nodes that have to be left out, and why.
  using LeaveOut = std::function<void(uint32_t node, std::string_view why)>;
  /// Returns what a projection node makes of the solids that it holds, which are known; nothing if
  /// it has to be left out, which is told.
  using Project = std::function<std::optional<FigureOperations>(const PlaneEvaluation& evaluation,
                                                                uint32_t node)>;

  /// Finds out what each node is as an operand.
  PlaneEvaluation(const PlaneSubtree& subtree, NodeProblems& problems, LeaveOut leave_out,
                  Project project);

  const NodeRow& row(uint32_t node) const { return subtree_.row(node); }
  template <typename Data>
  const Data& data(uint32_t node) const {
    return subtree_.data<Data>(node);
  }

  /// What the node is as an operand of the one around it; of the root, on its own. Of an extrusion
  /// that is the root, what its children are together.
  Presence presence(uint32_t node) const { return at(node).presence; }
  /// 2 or 3; 0: it has none.
  uint8_t dimension(uint32_t node) const { return at(node).dimension; }
  /// Returns whether the root makes something of solids.
  bool is_solid() const { return at(subtree_.root()).dimension == 3; }

  /// Returns figures whose union is the node's, in the coordinates around it. Of an extrusion that
  /// is the root, the figure is that of its children. Some node on the way to the root combines
  /// outlines, or find_all_figures() was called.
  const std::vector<Figure>& figures(uint32_t node) const { return at(node).figures; }
  /// Returns the matrix of a multmatrix or resize node that has figures.
  const HealedMatrix& matrix(uint32_t node) const { return at(node).matrix; }
  void set_map(uint32_t node, const PlaneMap& map) { at(node).matrix.map = in_space(map); }
  /// Returns figures under that matrix.
  std::vector<Figure> moved(std::vector<Figure> figures, uint32_t node) const;
  /// Returns what a projection node that is solid makes, in the coordinates around it.
  const FigureOperations& projection(uint32_t node) const { return at(node).projection; }
  /// Finds the figures of all nodes.
  void find_all_figures();
  /// Returns those of the operands, which must have been found.
  std::vector<Figure> union_of_operands(uint32_t node) const;
  /// Calls visit(child) for each child that is an operand.
  template <typename Visit>
  void visit_operands(uint32_t node, const Visit& visit) const {
    for (uint32_t c = node + 1; c < subtree_.end_of(node); c = subtree_.end_of(c)) {
      if (at(c).presence != Presence::kAbsent) visit(c);
    }
  }

 private:
  struct Node {
    Presence presence = Presence::kAbsent;
    uint8_t dimension = 0;  // 2 or 3; 0: it has none
    bool has_figures = false;
    std::vector<Figure> figures;
    HealedMatrix matrix;
    FigureOperations projection;
  };

  /// Returns whether the node is an extrusion whose solid is asked for, and not its figures alone.
  bool is_solid_extrusion(uint32_t node) const {
    const bool is_lowered = node == subtree_.root() && row(node).extruded != nullptr;
    return row(node).is_extrusion() && !is_lowered;
  }
  Node& at(uint32_t node) { return nodes_[node - subtree_.root()]; }
  const Node& at(uint32_t node) const { return nodes_[node - subtree_.root()]; }
  void find_presence(uint32_t node);
  void combine(uint32_t node);
  void project(uint32_t node);
  void ignore_other_dimension(uint32_t node, uint8_t dimension, NodeProblems& problems);
  Presence combined_presence(uint32_t node) const;
  void find_figures(uint32_t node);
  std::optional<std::vector<Figure>> combined_figures(uint32_t node);

  const PlaneSubtree& subtree_;
  NodeProblems& problems_;
  LeaveOut leave_out_;
  Project project_;
  std::vector<Node> nodes_;
};

}  // namespace frontend
