// The program scadray-bench, from its arguments to its exit code.
#pragma once

#include <string>
#include <vector>

#include "frontend/run_program.hpp"

namespace bench {

/// Messages go to stderr, the table or the JSON to stdout; nothing is thrown.
frontend::ExitCode run_command(const std::vector<std::string>& arguments);

}  // namespace bench
