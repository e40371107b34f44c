// The set operations of a 2D subtree, over its figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/profile.hpp"
#include "heal/frames.hpp"
#include "plane/figure.hpp"
#include "plane/plane_map.hpp"
#include "solids/operations.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {

/// A figure where it stands in the plane of a node, the root, around it.
struct PlacedFigure {
  std::shared_ptr<const Figure> figure;
  PlaneMap map;    // of its node, to the root's plane
  uint32_t frame;  // of which the map is the part within the root's
  uint32_t id;
  int fragments = 0;                                  // of a circle: OpenSCAD's
  PlaneMap place_in_node{};                           // of a letter
  std::shared_ptr<const csgcore::Profile> profile{};  // of the figure, where it is made already

  /// To the root's plane.
  PlaneMap place() const { return compose(map, place_in_node); }
};

/// The subtree as operations on figures.
using FigureTree = Operations<PlacedFigure>;

/// Returns the operations of a node of the subtree, which stands in `frame`; adds frames. Of an
/// extrusion they are those of its children. The places lead to the plane of that node.
FigureTree figure_tree(const SubtreeEvaluation& evaluation, uint32_t node, uint32_t frame,
                       FrameTree& frames);

/// Returns the union of figures that stand where the node does.
FigureTree union_of(std::span<const Figure> figures, uint32_t frame, uint32_t id);

/// Returns the bounds of the corners that OpenSCAD has of the figure, in the root's plane.
Rectangle faceted_bounds(const PlacedFigure& placed);

/// Returns the bounds of what is not subtracted.
Rectangle positive_bounds(const FigureTree& figures);

}  // namespace frontend
