// The options of the program `scadray`, one row each.
#pragma once

#include <span>

#include "command/option_row.hpp"

namespace frontend {

/// OpenSCAD's options, with its names.
std::span<const OptionRow> openscad_options();

/// Those that only scadray has.
std::span<const OptionRow> own_options();

}  // namespace frontend
