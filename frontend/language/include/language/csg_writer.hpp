// The text of a .csg, as OpenSCAD writes it (LANGUAGE.md, "The .csg writer").
#pragma once

#include <string>

#include "language/node_tree.hpp"

namespace language {

/// Returns the text of a tree: a line for each node, one for the end of each that has children, and
/// an empty line at the end. A tree with a root modifier (!) is written as that node alone. Needs
/// no recursion: trees may be arbitrarily deep.
std::string csg_text(const NodeTree& tree);

}  // namespace language
