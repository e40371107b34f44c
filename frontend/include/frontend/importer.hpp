// The tree of a design → csgcore::Scene (frontend/OPENSCAD.md, "What nodes mean").
#pragma once

#include <stop_token>

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"
#include "frontend/imported_design.hpp"

namespace frontend {

/// A node that is not drawn is left out, and an argument of the wrong type counts as missing,
/// as in OpenSCAD: there is one warning for each kind of node and reason, which names the first
/// with its place and says how many there are. A round primitive whose facets would take too much
/// memory stays smooth, with one warning for all. Throws nothing but Stopped (stop.hpp), where
/// `stop` asks for it.
ImportedDesign import_design(const DesignTree& tree, const ImportOptions& options = {},
                             const std::stop_token& stop = {});

}  // namespace frontend
