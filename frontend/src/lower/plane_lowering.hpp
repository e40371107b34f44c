// From a 2D subtree that OpenSCAD evaluates as a whole to primitives: an extrusion, a revolution,
// or the plate that stands for a plane figure in the preview.
//
// Set operations commute with extruding and revolving: a point of space lies in the result where a
// point of the plane that it is projected to lies in the figure. So they stay operations of the CSG
// tree, and each figure is extruded or revolved by itself.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "heal/frames.hpp"
#include "lower/figure_solids.hpp"
#include "lower/plane_evaluation.hpp"
#include "lower/plane_subtree.hpp"

namespace frontend {

struct LoweredSubtree {
  struct Part {
    csgcore::Primitive primitive;  // under its matrices, without a colour
    uint32_t frame;                // FrameTree
    csgcore::Box box;              // of the corners that OpenSCAD's facets have, in the world
  };
  std::vector<Part> parts;
  csgcore::CsgTree solid;  // over the parts
  bool is_plate = false;
  bool is_faceted = false;          // facets, finer than a pixel, stand for something round
  std::optional<csgcore::Box> box;  // of what the operations leave, where that is known
  /// It is a union, of which OpenSCAD takes the corners of the box in the root's coordinates: `box`
  /// is theirs, and may be larger than the boxes of the parts together.
  bool is_union = false;
};

/// What stands for a plane figure that is not extruded.
enum class Plate : uint8_t {
  kPreview,  // a plate that is a unit thick
  kFlat,     // so thin that it counts as flat
};

/// `frame` is where the root stands. The root is solid, and none of 3D. Adds frames, and tells of
/// what OpenSCAD tells: nothing is left then.
LoweredSubtree lower_subtree(const PlaneSubtree& subtree, PlaneEvaluation& evaluation, Plate plate,
                             uint32_t frame, FrameTree& frames, FigureSolids& solids,
                             NodeProblems& problems);

/// Makes a part of a plate that stands in that frame as thick as one that is subtracted.
void thicken_plate(csgcore::Primitive& part, const csgcore::Affine& frame_to_world);

}  // namespace frontend
