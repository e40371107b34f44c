// Which facets may meet, and which lie where no other operand has any.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "arrangement/facets.hpp"

namespace csgcore {

struct FacetPairs {
  /// Pairs of facets whose boxes meet, the lesser number first, in rising order.
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  /// Sets of facets of one operand that reach into a cell of space which no other operand's do.
  std::vector<std::vector<uint32_t>> alone;
};

/// Finds all pairs of different operands, and of one operand that may cross itself.
FacetPairs facet_pairs(const Facets& facets, const std::vector<bool>& may_cross_itself);

}  // namespace csgcore
