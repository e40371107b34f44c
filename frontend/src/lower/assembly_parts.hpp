// The parts of an assembly, which a section tells apart: what a design's text puts together last.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "language/node_tree.hpp"
#include "lower/resolved_modifiers.hpp"

namespace frontend {

/// Returns, for each of the nodes in `places` (ImportedDesign::places), the number of the part that
/// it is in; 0 for what the range does not hold. Where the tree of groups, matrices and colours
/// divides first, each child is a part, and so is each call in a module that only calls others.
/// What `union` or another operation puts together is one part; of a difference the first operand
/// is looked at.
std::vector<uint32_t> assembly_parts(const language::NodeTree& tree, const NodeRange& range,
                                     std::span<const uint32_t> places);

}  // namespace frontend
