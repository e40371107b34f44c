// What the nodes of a subtree yield: which are empty, which OpenSCAD ignores, and the figures or
// the solids of the others.
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
#include "solids/operations.hpp"
#include "solids/solid_shape.hpp"
#include "solids/solid_union.hpp"
#include "solids/solid_value.hpp"
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

class SubtreeEvaluation {
 public:
  /// Is told of nodes that have to be left out, and why.
  using LeaveOut = std::function<void(uint32_t node, std::string_view why)>;

  /// Finds out what a node of the subtree, the root, and each one below it is as an operand.
  SubtreeEvaluation(const Subtree& subtree, uint32_t root, const ImportOptions& options,
                    const SolidSources& sources, NodeProblems& problems, LeaveOut leave_out);

  const Subtree& subtree() const { return subtree_; }
  uint32_t root() const { return root_; }
  const NodeRow& row(uint32_t node) const { return subtree_.row(node); }
  template <typename Data>
  const Data& data(uint32_t node) const {
    return subtree_.data<Data>(node);
  }
  const SolidSources& sources() const { return sources_; }
  NodeProblems& problems() { return problems_; }

  /// What the node is as an operand of the one around it; of the root, on its own. Of an extrusion
  /// that is the root, what its children are together.
  Presence presence(uint32_t node) const { return at(node).presence; }
  /// Returns whether the root makes something of solids.
  bool is_solid() const { return at(root_).dimension == 3; }
  /// Calls visit(child) for each child that is an operand.
  template <typename Visit>
  void visit_operands(uint32_t node, const Visit& visit) const {
    for (uint32_t c = node + 1; c < subtree_.end_of(node); c = subtree_.end_of(c)) {
      if (at(c).presence != Presence::kAbsent) visit(c);
    }
  }

  // In the plane:
  /// Returns figures whose union is the node's, in the coordinates around it. Some node on the way
  /// to the root combines outlines, or find_all_figures() was called.
  const std::vector<Figure>& figures(uint32_t node) const { return at(node).figures; }
  /// Returns those of the operands, which must have been found.
  std::vector<Figure> figures_of_operands(uint32_t node) const;
  /// Finds the figures of all nodes.
  void find_all_figures();
  /// Returns the matrix of a multmatrix or resize node that has figures.
  const HealedMatrix& matrix(uint32_t node) const { return at(node).matrix; }
  void set_map(uint32_t node, const PlaneMap& map) { at(node).matrix.map = in_space(map); }
  /// Returns figures under that matrix.
  std::vector<Figure> moved(std::vector<Figure> figures, uint32_t node) const;
  /// Returns what a projection node that is solid makes, in the coordinates around it.
  const Operations<Figure>& projection(uint32_t node) const { return at(node).projection; }

  // In space:
  /// Returns the root's solid in its own coordinates: a union, or what resize() has of a tree.
  /// Nothing if it cannot be found: the root is left out.
  std::optional<SolidValue> solid();
  /// Returns the values of the operands that count, in their order; the nodes lose them.
  std::vector<SolidValue> solids_of_operands(uint32_t node);
  /// Returns parts whose union is the value, as far as that can be found (SolidUnion).
  std::vector<SolidPart> united(const SolidValue& value, int least_chords = kChordsOfCutDisc);
  /// GeometryDialect::keeps_colors.
  bool keeps_colors() const { return keeps_colors_; }
  /// The solid that is looked for cannot be found.
  void fail(std::string_view why);
  std::string_view failure() const { return failure_; }

 private:
  struct Node {
    Presence presence = Presence::kAbsent;
    uint8_t dimension = 0;  // 2 or 3; 0: it has none
    bool has_figures = false;
    std::vector<Figure> figures;
    HealedMatrix matrix;
    Operations<Figure> projection;
    SolidValue solid;  // until the node around it takes it
  };

  /// Returns whether the node is an extrusion whose solid is asked for, and not its figures alone.
  bool is_solid_extrusion(uint32_t node) const {
    const bool is_lowered = node == root_ && row(node).extruded != nullptr;
    return row(node).is_extrusion() && !is_lowered;
  }
  Node& at(uint32_t node) { return nodes_[node - root_]; }
  const Node& at(uint32_t node) const { return nodes_[node - root_]; }
  void find_presence(uint32_t node);
  void combine(uint32_t node);
  void project(uint32_t node);
  void ignore_other_dimension(uint32_t node, uint8_t dimension, NodeProblems& problems);
  Presence combined_presence(uint32_t node) const;
  void find_figures(uint32_t node);
  std::optional<std::vector<Figure>> combined_figures(uint32_t node);
  void find_solids(uint32_t node);
  std::vector<uint32_t> solid_nodes(uint32_t node) const;
  SolidValue combined_solid(uint32_t node);
  SolidValue solid_of_leaf(uint32_t node);
  Operations<Figure> section(uint32_t node);
  Operations<Figure> shadow(uint32_t node);

  const Subtree& subtree_;
  const uint32_t root_;
  const ImportOptions& options_;
  const SolidSources sources_;
  NodeProblems& problems_;
  const LeaveOut leave_out_;
  const bool keeps_colors_;
  std::vector<Node> nodes_;
  std::string_view failure_;
};

}  // namespace frontend
