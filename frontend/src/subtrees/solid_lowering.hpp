// From the solids of a subtree to primitives.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "csgcore/geometry.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_value.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// `frame`, which leads to the world by `to_world`, is where the root stands. The primitives have
/// that id.
LoweredSubtree lower_solid(const SolidValue& value, const csgcore::Affine& to_world, uint32_t frame,
                           uint32_t id, SolidPool& pool);

/// The solid of a node, and where its primitives belong.
struct PendingSolid {
  uint32_t node;
  uint32_t frame;
  csgcore::Affine to_world;  // of the frame
  uint32_t id;               // of its primitives
  size_t primitives_before;  // of the design
  SolidValue value;
};

/// Returns lower_solid() of each. Throws if it is stopped (throw_if_stopped).
std::vector<LoweredSubtree> lower_all(const std::vector<PendingSolid>& pending, SolidPool& pool,
                                      const std::stop_token& stop);

}  // namespace frontend
