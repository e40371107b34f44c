// Which operands of a solid nobody sees who looks at it from outside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"

namespace csgcore {

class OperandGroups;

/// Primitives, each of which stands in the tree once.
struct HiddenOperands {
  /// Voids in the solid's inside, and parts there. The operands, these among them, are all that
  /// stand in groups or take away. Around these the solid holds by the rest alone, and no other
  /// operand reaches in. Without them it is another solid, but no ray from outside gets to know: it
  /// has ended where it would get to one of them.
  std::vector<uint32_t> inside;
  /// Where they are, the solid does not depend on them.
  std::vector<uint32_t> cancelled;

  size_t count() const { return inside.size() + cancelled.size(); }
};

/// Those that are easily found: by boxes, balls about primitives, planes between them. What stands
/// around those of `inside` is at least `margin` thick, in world units. None if they are not many:
/// a smaller list would not pay.
HiddenOperands find_hidden_operands(const OperandGroups& groups,
                                    std::span<const CanonicalPrimitive> primitives, double margin);

}  // namespace csgcore
