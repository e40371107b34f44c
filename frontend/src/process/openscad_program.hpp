// Which program is OpenSCAD.
#pragma once

#include <string>

namespace frontend {

/// Returns the program that $OPENSCAD names, or else "openscad", which is looked up on PATH.
std::string openscad_program();

/// Returns what tells this openscad from others: the path of its file, that file's size and the
/// time of its last change. Empty if there is none.
std::string openscad_identity();

}  // namespace frontend
