// From what openscad has rendered to primitives.
#pragma once

#include <cstdint>
#include <optional>

#include "csgcore/geometry.hpp"
#include "lower/import_polyhedra.hpp"
#include "lower/lowered_subtree.hpp"
#include "meshes/ringed_faces.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// Returns the solid of a request for one (render_text.hpp), which stands in the frame. It has no
/// parts if it is empty.
LoweredSubtree lower_rendered_solid(const RingedFaces& faces, const csgcore::Affine& to_world,
                                    uint32_t frame, uint32_t id, PolyhedronPool& polyhedra);

/// Returns the figure of a request for one; nothing if it is empty.
std::optional<Figure> rendered_figure(const RingedFaces& faces);

}  // namespace frontend
