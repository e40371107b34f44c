// What the modifiers % # ! * do to each node of a file (frontend/OPENSCAD.md, "What nodes
// mean"; OpenSCAD 2021.01's preview).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"
#include "frontend/design_tree.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {

/// One node's part in the picture.
struct ResolvedNode {
  Presence presence = Presence::kSolid;
  /// The node's solid is overlaid: it has `#`, or consists of such parts only.
  bool highlighted = false;
  /// All operands are highlighted: the node keeps them, and is highlighted as a whole.
  bool keeps_highlighted = false;
};

/// A file's nodes as operands. Empty `nodes`: there is nothing special, all are solid or empty.
struct ResolvedModifiers {
  std::vector<ResolvedNode> nodes;
  std::vector<uint32_t> background;  // roots of the `%` parts, in file order
  std::vector<uint32_t> highlight;   // roots of the `#` parts, in file order
  bool keeps_highlighted = false;    // as in ResolvedNode, for the file's top level
};

/// The nodes that `!` leaves: the subtree of the first one that has it, or all.
struct NodeRange {
  uint32_t begin = 0;
  uint32_t end = 0;
  bool is_root = false;  // `!` selects it
};

/// Returns a node's CallModifiers. The one that `!` selects has lost all of its own.
inline uint8_t modifiers_of(const NodeTree& tree, const NodeRange& selected, uint32_t node) {
  return selected.is_root && node == selected.begin ? uint8_t{0} : tree.nodes[node].modifiers;
}

/// A node without children, or one that is taken as a whole.
struct LeafState {
  Presence presence = Presence::kEmpty;  // kSolid, kEmpty or kLeftOut
  csgcore::Box box;                      // world space, of a solid one
  bool is_whole = false;                 // its children are not looked at
};

/// `leaves` has the state of each node without children, of each that is taken as a whole, and of
/// each that cannot be drawn, whose children are not looked at either.
ResolvedModifiers resolve_modifiers(const NodeTree& tree, NodeRange selected,
                                    std::span<const LeafState> leaves, PictureKind picture);

}  // namespace frontend
