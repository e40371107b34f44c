// Starts a program that goes its own way, as an editor does.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace frontend {

/// Starts a program, looked up on PATH, with its arguments. It may outlive this program, gets no
/// terminal, an empty standard input, and no outputs. Its end is waited for in a thread of its own,
/// from which `on_end` is called with its exit code, or 128 plus the number of the signal that
/// ended it; or never, if this program ends first. Throws std::system_error if it cannot be
/// started.
void start_program(const std::vector<std::string>& command,
                   std::function<void(int exit_code)> on_end);

}  // namespace frontend
