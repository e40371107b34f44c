// The mesh of a figure that is revolved in sections.
#pragma once

#include "csgcore/primitive.hpp"
#include "plane/outlines.hpp"

namespace frontend {

/// How a full or partial turn is divided (frontend/OPENSCAD.md, "Extrusions").
struct TurnSections {
  double start = 0;  // degrees, of the first ring
  double angle = 360;
  int count = 3;
  bool is_closed() const { return angle == 360; }
  /// Where the rings stand, in degrees: those of a whole turn run clockwise.
  double azimuth(int ring) const {
    const double turn = angle * ring / count;
    return start + (is_closed() ? -turn : turn);
  }
};

/// Returns OpenSCAD's mesh of the polygons, revolved about z: x becomes the radius, and y becomes
/// z. It is closed. All points have x ≥ 0, or all x ≤ 0. The polygons do not cross.
csgcore::Primitive revolved_mesh(const SimplePolygons& polygons, const TurnSections& sections);

}  // namespace frontend
