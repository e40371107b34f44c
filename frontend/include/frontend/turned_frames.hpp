// The coordinates in which a design states its solids, where they are turned against each other.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"

namespace frontend {

/// Coordinates whose axes do not run along those of the coordinates around them.
struct TurnedFrame {
  uint32_t parent = 0;  // the turned frame around it
  uint32_t depth = 0;   // 0: the world
  csgcore::Affine to_world;
};

/// The turned frames of a design. Number 0 is the world, and a parent stands before its children.
struct TurnedFrames {
  std::vector<TurnedFrame> frames;
  std::vector<uint32_t> of_primitive;  // of the scene
};

}  // namespace frontend
