// The text of a .csg, as OpenSCAD writes it (LANGUAGE.md, "The .csg writer").
#pragma once

#include <string>

#include "language/node.hpp"

namespace language {

/// Returns the text of the tree below `root`, which itself is not written: a line for each node,
/// and an empty line at the end. A tree with a root modifier (!) is written as that node alone.
/// Needs no recursion: trees may be arbitrarily deep.
std::string csg_text(const Node& root);

}  // namespace language
