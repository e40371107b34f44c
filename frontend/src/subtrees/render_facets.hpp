// How finely openscad divides what is round in a part of a design that it renders.
#pragma once

#include <cstdint>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"

namespace frontend {

/// Returns the $fn of each node of the subtree, the root's first; 0: its own arguments stay.
///
/// Where facets are not kept, what is round gets so many that they are below a pixel or about one,
/// as long as openscad takes some seconds for all: it takes a millisecond for a facet, and in a
/// Minkowski sum for each pair of one. Nothing gets fewer than the design gives it.
std::vector<double> render_fragments(const NodeTree& tree, uint32_t root,
                                     const ImportOptions& options);

}  // namespace frontend
