// The text that CGAL writes of a Nef polyhedron: OpenSCAD's .nef3.
#pragma once

#include <optional>
#include <string_view>

#include "meshes/ringed_faces.hpp"

namespace frontend {

/// Returns the boundary of the solid: the faces that have it on one side, seen from the other. The
/// coordinates in the text are fractions of whole numbers of any length; the results are within a
/// rounding of them, or two. Sheets and lines without thickness are left out. Nothing if the text
/// is damaged.
std::optional<RingedFaces> read_nef_text(std::string_view text);

}  // namespace frontend
