// From the solids of a subtree that OpenSCAD evaluates as a whole to primitives.
#pragma once

#include <cstdint>

#include "csgcore/geometry.hpp"
#include "lower/hull_pool.hpp"
#include "lower/lowered_subtree.hpp"
#include "lower/solid_value.hpp"

namespace frontend {

/// `frame`, which leads to the world by `to_world`, is where the root stands. The primitives have
/// that id.
LoweredSubtree lower_solid(const SolidValue& value, const csgcore::Affine& to_world, uint32_t frame,
                           uint32_t id, HullPool& hulls);

}  // namespace frontend
