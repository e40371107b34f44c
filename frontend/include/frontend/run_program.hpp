// The frame of every program's main: exit codes, and errors that end the program.
#pragma once

#include <functional>
#include <string>

namespace frontend {

/// The exit codes of frontend/OPTIONS.md. Only `scadray validate` and `scadray check` have
/// kDisagreement.
enum class ExitCode : int { kDone = 0, kFailure = 1, kDisagreement = 2 };

/// Runs a program, flushes its output, and reports any exception on stderr; nothing is thrown.
/// `smaller` is the advice for a run that is out of memory: "a smaller …".
ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller);

}  // namespace frontend
