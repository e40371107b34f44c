// A subtree as a design for openscad.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"
#include "rendered/rendering.hpp"

namespace frontend {

/// OpenSCAD cuts coordinates of solids to multiples of 2^-20 before it combines them. So everything
/// in the text of solids is larger by this factor, and the results are as near to the exact solids
/// beside them as 2^-30.
constexpr double kRenderScale = 1024;

/// Returns whether OpenSCAD 2021.01 knows all nodes of the subtree.
bool may_be_rendered(const NodeTree& tree, uint32_t root);

/// Returns the request for the subtree, whose root stands in its own coordinates. Equal geometry
/// has equal texts, whatever the spaces, colours and modifiers in the file. Matrices are healed, as
/// those around it are. A plane figure is extruded to z from 0 to 1, without a factor. `fonts` are
/// the font files that the design brings along.
RenderRequest render_request(const NodeTree& tree, uint32_t root, bool is_plane,
                             const ImportOptions& options, const std::vector<std::string>& fonts);

/// Returns the subtree, a solid whose root stands in its own coordinates, as a design for openscad
/// that is nothing but it, unscaled.
std::string subtree_text(const NodeTree& tree, uint32_t root, const ImportOptions& options,
                         const std::vector<std::string>& fonts);

}  // namespace frontend
