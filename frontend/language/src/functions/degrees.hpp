// Sine and cosine of degrees, as OpenSCAD computes them (LANGUAGE.md, "Builtin functions").
#pragma once

namespace language {

/// Both are exact where the true value is, at multiples of 30 and 45 degrees, and nan of an angle
/// that is not finite, or so large that whole turns are not told apart.
double sine_of_degrees(double angle_deg);
double cosine_of_degrees(double angle_deg);

}  // namespace language
