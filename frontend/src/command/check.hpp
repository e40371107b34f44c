// `scadray check`: compares what scadray and openscad make of designs.
#pragma once

#include <string>
#include <vector>

#include "frontend/run_program.hpp"

namespace frontend {

/// Evaluates each file by both, and says on standard output whether the trees and the messages are
/// the same, or where they differ first. Words before the files that begin with a dash are
/// OpenSCAD's options: -D, -p, -P, --hardwarnings, --check-parameters, --check-parameter-ranges.
/// Returns kDisagreement if there is any difference. Throws Error.
ExitCode check_designs(const std::vector<std::string>& arguments);

}  // namespace frontend
