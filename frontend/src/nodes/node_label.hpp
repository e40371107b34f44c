// A node in few words.
#pragma once

#include <string>

#include "frontend/design_tree.hpp"

namespace frontend {

/// Returns the node's name with those arguments that tell what it is, in OpenSCAD's words:
/// "cylinder(h = 10, r = 2)", "linear_extrude(height = 5)", "polyhedron(12 faces)", "hull()".
std::string label_of(const NodeTree& tree, const Node& node);

}  // namespace frontend
