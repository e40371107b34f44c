// Which operands of a solid nobody sees who looks at it from outside.
#pragma once

#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "solid/operand_groups.hpp"

namespace csgcore {

/// Those that are easily found: by boxes, balls about primitives, planes between them. What stands
/// around those of `inside` is at least `margin` thick, in world units. None if they are not many:
/// a smaller list would not pay.
HiddenOperands find_hidden_operands(const OperandGroups& groups,
                                    std::span<const CanonicalPrimitive> primitives, double margin);

}  // namespace csgcore
