// A subtree that OpenSCAD evaluates as a whole: what its nodes' arguments say.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "solids/import_files.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {

/// The nodes of the subtree, in the tree's order, as far as they were taken.
class Subtree {
 public:
  Subtree(const NodeTree& tree, uint32_t root) : tree_(tree), root_(root) {}

  /// Reads the arguments of the next node of the subtree, and the drawing that it names. `id` is
  /// its place among the primitive nodes. The files must outlive this.
  void take(uint32_t id, const NodeSources& sources, FileImports& files, NodeProblems& problems);

  const NodeTree& tree() const { return tree_; }
  uint32_t root() const { return root_; }
  /// Of the last descendant, one more.
  uint32_t end() const { return root_ + static_cast<uint32_t>(nodes_.size()); }
  /// One past the node's last descendant.
  uint32_t end_of(uint32_t node) const { return tree_.nodes[node].end; }
  const Node& syntax(uint32_t node) const { return tree_.nodes[node]; }
  const NodeRow& row(uint32_t node) const { return row_of(tree_.nodes[node].kind); }
  /// Returns the id of the primitives of the node, which is that of its first primitive node.
  uint32_t id(uint32_t node) const { return nodes_[node - root_].id; }
  /// Returns the drawing that the node names; null if it names none.
  const ImportedDrawing* drawing(uint32_t node) const { return nodes_[node - root_].drawing; }
  const NodeData& data(uint32_t node) const { return nodes_[node - root_].data; }
  template <typename Data>
  const Data& data(uint32_t node) const {
    return std::get<Data>(data(node));
  }

 private:
  struct Taken {
    uint32_t id = 0;
    NodeData data;
    const ImportedDrawing* drawing = nullptr;
  };
  const NodeTree& tree_;
  uint32_t root_;
  std::vector<Taken> nodes_;
};

}  // namespace frontend
