// The program scadray-validate, from its arguments to its exit code.
#pragma once

#include <string>
#include <vector>

#include "frontend/run_program.hpp"

namespace validation {

/// Messages go to stderr, the table to stdout; nothing is thrown.
frontend::ExitCode run_command(const std::vector<std::string>& arguments);

}  // namespace validation
