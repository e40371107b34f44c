// Facets without which the solid's boundary is the same, and those that no other surface comes
// near, found before any two are compared.
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/covers.hpp"
#include "arrangement/facet_trees.hpp"

namespace csgcore {

struct NeededFacets {
  /// By facet: the first one of its patch, or kNoPlace if it is left out. None that is left out is
  /// part of the boundary: it lies inside or outside another operand, apart from its surface, where
  /// that operand alone decides an operation on both, as one within a subtracted ball does.
  /// Facets that no other surface comes near, and that have corners in common, are a patch: all of
  /// them are part of the boundary, or none. Any other facet is one by itself.
  std::vector<uint32_t> first_of;
  /// The first facets of all patches, in rising order.
  std::vector<uint32_t> firsts;
};

NeededFacets needed_facets(const Facets& facets, const FacetTrees& trees, const Covers& covers,
                           const std::vector<bool>& may_cross_itself);

}  // namespace csgcore
