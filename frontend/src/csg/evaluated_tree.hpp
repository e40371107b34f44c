// The syntax tree of a design that frontend/language has evaluated.
#pragma once

#include <string>

#include "frontend/syntax_tree.hpp"
#include "language/node_tree.hpp"
#include "language/source_files.hpp"

namespace frontend {

/// Returns what messages call a file that is read beside the main one: its path, seen from the
/// working folder if it is within.
std::string shown_name(const std::string& path);

/// Returns the tree that a .csg of the same design would have, with all digits of its numbers, and
/// with places in the design's own files. `name` is what messages call the main file, the first of
/// `files`. Values that no node takes, ranges and functions, become undef. Needs no recursion.
SyntaxTree tree_of(const language::NodeTree& tree, const language::SourceFiles& files,
                   std::string name);

/// Returns the tree of one node alone, as if it had no children.
SyntaxTree tree_without_children(const language::NodeTree& from, uint32_t node,
                                 const language::SourceFiles& files);

}  // namespace frontend
