// Numbers as text, in OpenSCAD's two formats (LANGUAGE.md, "Values").
#pragma once

#include <string>

namespace language {

/// Appends a number as echo() shows it: six significant digits, exact ties away from zero,
/// "1e+6" and "1e-6" where the exponent is outside [-5, 5].
void append_echo_number(std::string& out, double number);

/// Appends a number as C's "%g" does, in which most of a .csg is written.
void append_general_number(std::string& out, double number);

}  // namespace language
