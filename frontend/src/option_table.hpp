// The options that the command knows. Boost.ProgramOptions is what OpenSCAD reads its own command
// line with, so its syntax (abbreviated long options, `--render x.scad` taking the file's name as
// its value, `-oFILE`) is the same by construction.
#pragma once

#include <boost/program_options.hpp>

namespace frontend {

/// OpenSCAD's options, with its names.
boost::program_options::options_description openscad_options();

/// Those that only scadray has.
boost::program_options::options_description own_options();

}  // namespace frontend
