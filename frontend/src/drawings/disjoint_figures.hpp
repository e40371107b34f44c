// Fewer figures with the same union.
#pragma once

#include <vector>

#include "plane/figure.hpp"

namespace frontend {

/// Returns figures with the union of these: those whose boxes are disjoint become one outline, and
/// so do polygons that meet, and any figures that meet if there are many. If there are few discs,
/// they stay discs.
std::vector<Figure> disjoint_figures(std::vector<Figure> figures);

/// Returns whether the figure has very many edges, most of which cross so many others that it would
/// take too long to draw. To tell takes time in proportion to the edges.
bool is_tangle(const Figure& figure);

}  // namespace frontend
