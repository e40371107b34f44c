// A subtree as a design for openscad.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"

namespace validation {

/// Returns the subtree, a solid whose root stands in its own coordinates, as a design for openscad
/// that is nothing but it. Equal geometry has equal texts, whatever the spaces, colours and
/// modifiers in the file. Matrices are healed, as those around it are. `fonts` are the font files
/// that the design brings along.
std::string subtree_text(const frontend::NodeTree& tree, uint32_t root,
                         const frontend::ImportOptions& options,
                         const std::vector<std::string>& fonts);

}  // namespace validation
