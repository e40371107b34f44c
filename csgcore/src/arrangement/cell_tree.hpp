// A kd-tree over all facets, whose cells hold what is left of the CSG tree there (the paper's §2,
// for surfaces): facets are compared only where they can matter to the solid.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/exact_center.hpp"
#include "arrangement/facet_trees.hpp"
#include "arrangement/tree_values.hpp"

namespace csgcore {

/// What the solid has of a face: nothing, or its front or back.
struct KeptFace {
  /// 1: the solid lies behind the face, and its normal points out of it; -1: the other way; 0: the
  /// solid lies on both sides, or on neither.
  int sign = 0;
  uint32_t operand = 0;  // whose face it shows
};

class CellTree {
 public:
  /// Divides these facets. Keeps references to all facets and to the trees.
  CellTree(const Facets& facets, const FacetTrees& trees, std::span<const CsgToken> tree,
           const std::vector<bool>& may_cross_itself, const std::vector<uint32_t>& divided);
  ~CellTree();
  CellTree(const CellTree&) = delete;
  CellTree& operator=(const CellTree&) = delete;

  /// Facets that reach into a cell where nothing but their operand matters.
  struct Alone {
    std::vector<uint32_t> facets;
    KeptFace kept;
  };
  const std::vector<Alone>& alone() const { return alone_; }
  /// Other facets that matter somewhere; they may be there twice.
  const std::vector<uint32_t>& others() const { return others_; }
  /// Pairs of facets that may meet where both matter, the lesser number first, in rising order.
  const std::vector<std::pair<uint32_t, uint32_t>>& pairs() const { return pairs_; }

  /// Returns what the solid has of a triangle, to whose inside no facet that matters comes but
  /// those `over` it, in whose plane it lies; the normal is that of the first of them. `axis` is
  /// one along which the plane is seen well.
  KeptFace kept(const std::array<const ArrangedPoint*, 3>& triangle, int axis,
                std::span<const uint32_t> over) const;

 private:
  struct Cell;
  class Builder;

  const Facets& facets_;
  const FacetTrees& trees_;
  std::unique_ptr<Cell> root_;
  std::vector<Alone> alone_;
  std::vector<uint32_t> others_;
  std::vector<std::pair<uint32_t, uint32_t>> pairs_;
};

}  // namespace csgcore
