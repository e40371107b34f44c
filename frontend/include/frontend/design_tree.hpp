// The tree of a design's nodes, as it was evaluated or as a .csg holds it, and where they stand.
#pragma once

#include <memory>
#include <string>

#include "frontend/error.hpp"
#include "language/node_tree.hpp"
#include "language/source_files.hpp"

namespace language {
struct Evaluation;
}  // namespace language

namespace frontend {

using language::Node;
using language::NodeKind;
using language::NodeTree;

/// Shared by all who draw the design and look nodes up in it. Whoever only reads the tree copies no
/// language::Value of it: several threads may read it, and values are counted without locks.
struct DesignTree {
  std::shared_ptr<const NodeTree> nodes;               // null: nothing was read yet
  std::shared_ptr<const language::SourceFiles> files;  // what the nodes' places refer to
  std::string name;                                    // what messages call the main file

  /// Returns the line and the column of a place; nothing of one that is in no file.
  Location location_of(language::Place place) const;
  /// Returns what messages call the file of a place.
  std::string file_of(language::Place place) const;
};

/// Returns what messages call a file that is read beside the main one: its path, seen from the
/// working folder if it is within.
std::string shown_name(const std::string& path);

/// Returns the tree of an evaluated design. `name` is what messages call its main file.
DesignTree tree_of(const language::Evaluation& evaluation, std::string name);

}  // namespace frontend
