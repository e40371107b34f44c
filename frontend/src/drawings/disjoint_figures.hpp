// Fewer figures with the same union.
#pragma once

#include <vector>

#include "plane/figure.hpp"

namespace frontend {

/// Returns figures with the union of these: those whose boxes are disjoint become one outline, and
/// polygons that meet are united, as far as that can be afforded. Circles by themselves stay discs
/// if there are few.
std::vector<Figure> disjoint_figures(std::vector<Figure> figures);

}  // namespace frontend
