// The solid under a roof.
#pragma once

#include "csgcore/primitive.hpp"
#include "plane/roof.hpp"

namespace frontend {

/// Returns the closed mesh between the roof and the plane z = 0.
csgcore::Primitive roof_mesh(const Roof& roof);

}  // namespace frontend
