// Sine and cosine of angles in degrees, as OpenSCAD computes them: exact at multiples of 30 and 45,
// and otherwise the same operations in the same order, so that the bits are OpenSCAD's.
#pragma once

namespace csgcore {

/// Precondition: 0 ≤ angle_deg < 360.
double sin_degrees(double angle_deg);
double cos_degrees(double angle_deg);

}  // namespace csgcore
