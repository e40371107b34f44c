// The data of an SVG path.
#pragma once

#include <string_view>
#include <vector>

#include "drawings/curve_path.hpp"

namespace frontend {

/// What a path draws: closed parts, which are filled, and open ones, which a pen follows.
struct SvgPath {
  std::vector<CurvePath> filled;
  std::vector<CurvePath> open;
};

/// Reads the attribute `d`, by OpenSCAD 2021.01's rules (svg.cpp). A
/// number that cannot be read is 0, and an incomplete set of numbers is left out.
SvgPath read_svg_path(std::string_view data);

/// Returns the part of an ellipse with the axes rx along (cos, sin) of the rotation, and ry, both
/// not 0, from one point to another one; scaled up if it cannot reach both.
EllipseArc svg_arc(const Vec2& from, const Vec2& to, Vec2 radii, double rotation_deg, bool is_large,
                   bool is_clockwise_on_paper);

/// Returns the chords that OpenSCAD has for an arc.
int svg_arc_pieces(double sweep);

}  // namespace frontend
