// The frame around every program's main: its exit code, and what ends it.
#pragma once

#include <functional>
#include <string>

namespace frontend {

/// The exit statuses of frontend/OPTIONS.md. kDisagreement is `scadray validate`'s alone.
enum class ExitCode : int { kDone = 0, kFailure = 1, kDisagreement = 2 };

/// Runs a program, writes out what it has printed, and says on stderr what ends it instead: nothing
/// is thrown. `smaller` is what to try where memory runs out: "a smaller …".
ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller);

}  // namespace frontend
