// From what a subtree yields to primitives: an extrusion, a revolution, the plate that stands for a
// plane figure in the preview, or a solid.
//
// Set operations commute with extruding and revolving: a point of space lies in the result where a
// point of the plane that it is projected to lies in the figure. So they stay operations of the CSG
// tree, and each figure is extruded or revolved by itself.
#pragma once

#include <cstdint>

#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "heal/frames.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_value.hpp"
#include "subtrees/lowered_subtree.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {

/// What stands for a plane figure that is not extruded.
enum class Plate : uint8_t {
  kPreview,  // a plate that is a unit thick
  kFlat,     // so thin that it counts as flat
};

/// `frame` is where the root stands. The root is solid, and none of 3D. Adds frames, and tells of
/// what OpenSCAD tells: nothing is left then.
LoweredSubtree lower_figures(SubtreeEvaluation& evaluation, Plate plate, uint32_t frame,
                             FrameTree& frames);

/// Makes a part of a plate that stands in that frame as thick as one that is subtracted.
void thicken_plate(csgcore::Primitive& part, const csgcore::Affine& frame_to_world);

/// Returns the primitives of a solid, which have that id. `frame`, which leads to the world by
/// `to_world`, is where its node stands. Any threads may call it.
LoweredSubtree lower_solid(const SolidValue& value, const csgcore::Affine& to_world, uint32_t frame,
                           uint32_t id, SolidPool& pool);

}  // namespace frontend
