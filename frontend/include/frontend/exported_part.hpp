// A part of an exported solid.
#pragma once

#include <optional>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

/// A part of a solid that has one colour, or none. The parts of a solid share no volume, and where
/// two of them meet, both have a surface.
struct ExportedPart {
  csgcore::TriangleSet surface;
  std::optional<csgcore::Color> color;
};

}  // namespace frontend
