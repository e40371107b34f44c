// Which program is OpenSCAD, and what it knows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process/child_process.hpp"

namespace frontend {

/// Returns the program that $SCADRAY_OPENSCAD names, or else $OPENSCAD; or else openscad-nightly if
/// that is on PATH, and else "openscad".
std::string openscad_program();

/// Starts openscad, the first word of the setup's command. `need` begins the Error that is thrown
/// where it is missing ("a .nef3 file is written by OpenSCAD"); `otherwise` ends its advice.
ChildProcess start_openscad(const ChildSetup& setup, const std::string& need,
                            const std::string& otherwise = {});

/// Runs openscad, and returns what it says on its standard output and its standard error. Throws
/// what start_openscad() does, for `scadray check`.
std::string said_by_openscad(const std::vector<std::string>& arguments);

/// Returns those of the options that the installed openscad knows, by its --help: 2021.01 has fewer
/// than its development snapshots. An option is a word "--name" or "--name=value", or one letter
/// with its value as the next word, which every version knows. `warn` is called for each of the
/// others with a line that says so.
std::vector<std::string> known_to_openscad(
    const std::vector<std::string>& options,
    const std::function<void(const std::string& line)>& warn);

}  // namespace frontend
