// The frame of every program's main: exit codes, errors that end the program, and subcommands that
// are programs of their own, as git's are.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace frontend {

/// The exit codes of frontend/OPTIONS.md. Only `scadray validate` and `scadray check` have
/// kDisagreement.
enum class ExitCode : int { kDone = 0, kFailure = 1, kDisagreement = 2 };

/// What a subcommand is asked for: its work, or one of its texts.
enum class ProgramRequest : uint8_t { kWork, kHelp, kVersion };

/// Prints the text that is asked for, of which these are the two. Returns whether one was.
bool print_requested(ProgramRequest request, const std::string& help, const std::string& version);

/// Runs a program, flushes its output, and reports any exception on stderr; nothing is thrown.
/// `smaller` is the advice for a run that is out of memory: "a smaller …".
ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller);

/// Replaces this program by the program `scadray-NAME` in the same folder. Returns only by throwing
/// Error, if there is no such program or it cannot be run. `todo` is the error's advice in the
/// former case.
[[noreturn]] void run_subcommand(const std::string& name, const std::vector<std::string>& arguments,
                                 const std::string& todo);

}  // namespace frontend
