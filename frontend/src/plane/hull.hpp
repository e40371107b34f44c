// The convex hull of discs and points in the plane.
#pragma once

#include <span>

#include "plane/figure.hpp"

namespace frontend {

/// Returns the hull's outline, counterclockwise: lines, and arcs where a disc shows. A lone disc is
/// that disc. Without loops if nothing is enclosed.
Figure convex_hull(std::span<const Disc> discs);

/// Adds discs to `discs` whose hull is the figure's: itself if it is a disc, else the points of its
/// loops, with chords in place of curves.
void add_hull_points(const Figure& figure, std::vector<Disc>& discs);

}  // namespace frontend
