// Syntax tree → csgcore::Scene (openscad.md §2, design.md §3).
#pragma once

#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/scene.hpp"
#include "frontend/error.hpp"
#include "frontend/syntax_tree.hpp"

namespace frontend {

struct ImportOptions {
  /// Leave out nodes that cannot be drawn, with one warning for each kind and its count, instead of
  /// throwing an Error.
  bool skip_unsupported = false;
};

struct ImportedDesign {
  csgcore::Scene scene;
  /// What OpenSCAD's --viewall looks at: the union of the positive leaves' boxes, each the box of
  /// the corners of the (faceted, openscad.md §3) leaf's local box under its matrix, `%` and `#`
  /// parts included (openscad.md §4). Empty for an empty design.
  csgcore::Box view_box;
  /// Primitive nodes in the file, empty, invalid and `%` ones included.
  uint32_t primitive_nodes = 0;
  std::vector<Warning> warnings;
};

/// Throws Error for a node that cannot be drawn (it names the first with its place, and says how
/// many there are) and for arguments of the wrong type.
ImportedDesign import_design(const SyntaxTree& tree, const ImportOptions& options = {});

}  // namespace frontend
