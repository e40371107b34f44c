// Parts of a solid that lie apart from one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/triangle_set.hpp"

namespace csgcore {

/// Operands of a union that reach into one another's boxes, or may.
struct SeparatePart {
  std::vector<uint32_t> operands;  // in rising order
  std::vector<CsgToken> tokens;    // over places in `operands`
};

/// Divides the operands of the union that the tree is at planes across the axes on which none of
/// them lies, so that the solid is the union of the parts, of which no two touch. A tree that is no
/// union is one part. Parts are in the order of their first operands; none is empty.
std::vector<SeparatePart> separate_parts(std::span<const TriangleSet> operands,
                                         const CsgTree& tree);

}  // namespace csgcore
