// Subcommands that are programs of their own, as git's are.
#pragma once

#include <string>
#include <vector>

namespace frontend {

/// Replaces this program by the program `scadray-NAME` in the same folder. Returns only by throwing
/// Error, if there is no such program or it cannot be run. `todo` is the error's advice in the
/// former case.
[[noreturn]] void run_subcommand(const std::string& name, const std::vector<std::string>& arguments,
                                 const std::string& todo);

}  // namespace frontend
