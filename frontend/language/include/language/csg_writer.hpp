// The text of a .csg, as OpenSCAD writes it.
// - A root (`!`) is written alone, without its own `%` and `#`; its descendants keep theirs. It is
//   the first node, depth first, that has the modifier; a later one that stems from another call is
//   warned of.
// - Modifiers stand before the indentation, `%` before `#`.
// - Matrices, and the lists of polygons and polyhedra, are spelled as echo spells them; other
//   numbers by `%g`.
#pragma once

#include <string>

#include "language/node_tree.hpp"

namespace language {

/// Returns the text of a tree: a line for each node, one for the end of each that has children, and
/// an empty line at the end. A tree with a root modifier (!) is written as that node alone. Needs
/// no recursion: trees may be arbitrarily deep.
std::string csg_text(const NodeTree& tree);

}  // namespace language
