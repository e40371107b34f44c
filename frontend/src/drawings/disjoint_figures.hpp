// Fewer figures with the same union.
#pragma once

#include <vector>

#include "plane/figure.hpp"

namespace frontend {

/// Returns figures with the union of these: those whose boxes are disjoint become one outline, and
/// so do polygons that meet, and any figures that meet if there are many. If there are few discs,
/// they stay discs.
std::vector<Figure> disjoint_figures(std::vector<Figure> figures);

/// Returns whether so many edges overlap, for their number, that it would take too long to draw
/// them. To tell takes time in proportion to the edges.
bool is_tangle(const Figure& figure);

}  // namespace frontend
