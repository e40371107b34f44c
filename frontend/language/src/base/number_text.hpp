// Numbers as text, in OpenSCAD's two formats (LANGUAGE.md, "Values").
#pragma once

#include <cstddef>
#include <string>

namespace language {

/// Appends a number as echo() shows it: six significant digits, exact ties away from zero,
/// "1e+6" and "1e-6" where the exponent is outside [-5, 5].
void append_echo_number(std::string& out, double number);

/// Appends a number as C's "%g" does, in which most of a .csg is written.
void append_general_number(std::string& out, double number);

/// Characters that either of them takes at most: "-1.23457e+308".
constexpr size_t kMostNumberText = 13;
/// Writes what append_echo_number() appends. Returns its end.
char* put_echo_number(char* out, double number);

}  // namespace language
