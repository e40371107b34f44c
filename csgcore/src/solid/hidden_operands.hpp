// Operands of a solid that cannot be seen from outside.
#pragma once

#include <span>

#include "csgcore/canonical_primitive.hpp"
#include "solid/operand_groups.hpp"

namespace csgcore {

/// Returns hidden operands that are easily found: by boxes, balls about primitives, and planes
/// between primitives. The solid around those of `inside` is at least `margin` thick, in world
/// units. Returns none if there are few, since a slightly smaller list does not pay.
HiddenOperands find_hidden_operands(const OperandGroups& groups,
                                    std::span<const CanonicalPrimitive> primitives, double margin);

}  // namespace csgcore
