// Which program is OpenSCAD.
#pragma once

#include <string>

namespace frontend {

/// Returns the program that $OPENSCAD names, or else "openscad", which is looked up on PATH.
std::string openscad_program();

}  // namespace frontend
