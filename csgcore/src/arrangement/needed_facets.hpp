// Facets without which the solid's boundary is the same, found before any two are compared.
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/covers.hpp"
#include "arrangement/facet_trees.hpp"

namespace csgcore {

/// Returns facets in rising order. None that is left out is part of the boundary: it lies inside or
/// outside another operand, apart from its surface, where that operand alone decides an operation
/// on both, as one within a subtracted ball does.
std::vector<uint32_t> needed_facets(const Facets& facets, const FacetTrees& trees,
                                    const Covers& covers);

}  // namespace csgcore
