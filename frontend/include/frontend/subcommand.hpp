// Subcommands that are programs of their own, as git's are.
#pragma once

#include <string>
#include <vector>

namespace frontend {

/// Runs the program `scadray-NAME` that lies beside this one, in its place: returns only by
/// throwing Error, where there is none or it cannot be run. `todo`: what to do where there is none.
[[noreturn]] void run_subcommand(const std::string& name, const std::vector<std::string>& arguments,
                                 const std::string& todo);

}  // namespace frontend
