// Where the mesh of an extruded or revolved figure ends.
#pragma once

#include <cstdint>

namespace frontend {

enum class MeshEnds : uint8_t {
  kBeyond,  // further on, within what has to be cut away: the cut makes its ends plane
  kExact,   // where the solid does
};

}  // namespace frontend
