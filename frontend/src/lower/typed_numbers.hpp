// The numbers of nodes that a person has typed with few digits in place of longer ones
// (frontend/HEALING.md, "Designs with all digits").
#pragma once

#include <cstdint>

#include "frontend/design_tree.hpp"
#include "heal/matrix_healing.hpp"

namespace frontend {

/// Returns the identity, with what the typed numbers of a node and its descendants may be off by as
/// its errors: as if a matrix had moved and scaled the node by as much. Exact if there are none.
/// `tree` must have the arguments still.
HealedMatrix typed_numbers(const NodeTree& tree, uint32_t node);

}  // namespace frontend
