// Trigonometry in degrees, exact where OpenSCAD's is (builtin_functions.hpp).
#pragma once

namespace language {

/// Return NaN for what is infinite, NaN, or too large for a remainder to mean anything.
double sine_of_degrees(double degrees);
double cosine_of_degrees(double degrees);
/// OpenSCAD counts half turns in 32 bits: above these it takes the nearest number, or the least.
double tangent_of_degrees(double degrees, bool has_nearest_integers = false);

/// Return degrees, rounded to an integer where the rounded angle has exactly the given value.
double arc_sine_degrees(double sine);
double arc_cosine_degrees(double cosine);
double arc_tangent_degrees(double tangent);

/// Returns the angle of (x, y) in degrees, rounded where it is within 3e-14 of an integer.
double arc_tangent_degrees(double y, double x);

}  // namespace language
