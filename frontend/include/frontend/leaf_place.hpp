// Where a leaf of a design stands in the design's text, and the calls that led to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/source_place.hpp"

namespace frontend {

struct TrailStep {
  std::string what;  // the node in few words, or the call as the design spells it
  SourcePlace place;
};

/// The way to a leaf, from the inside out: what it is made of, if that is one primitive; the calls
/// of the design's own modules that stand in between; the leaf; and the calls that it stands in.
/// Control structures, transformations and operations are no steps.
struct LeafPlace {
  std::vector<TrailStep> trail;  // never empty
  std::size_t leaf = 0;          // its index in the trail

  const TrailStep& step() const { return trail[leaf]; }
};

/// `node` is one of ImportedDesign::places. A .csg has no calls: the trail is in the .csg.
LeafPlace leaf_place(const DesignTree& tree, uint32_t node);

}  // namespace frontend
