// Extruded and revolved figures within a subtree of solids that OpenSCAD evaluates as a whole.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lower/figure_solids.hpp"
#include "lower/plane_subtree.hpp"
#include "lower/solid_value.hpp"

namespace frontend {

/// Returns parts whose union is the extrusion of the union of the figures; nothing if their edges
/// cross too often. One that turns is a mesh.
std::optional<std::vector<SolidPart>> extruded_parts(const LinearExtrudeNode& node,
                                                     std::span<const Figure> figures,
                                                     FigureSolids& solids);

/// Returns parts whose union is the revolution of the union of the figures; nothing if their edges
/// cross too often, or if they lie on both sides of the axis. One that is faceted, or that is no
/// full turn, is a mesh.
std::optional<std::vector<SolidPart>> revolved_parts(const RotateExtrudeNode& node,
                                                     std::span<const Figure> figures,
                                                     FigureSolids& solids);

}  // namespace frontend
