// The program `scadray`, from its arguments to its exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frontend/render.hpp"

namespace frontend {

/// The exit statuses of frontend/OPTIONS.md. kDisagreement is `scadray validate`'s alone.
enum class ExitCode : int { kDone = 0, kFailure = 1, kDisagreement = 2 };

/// Runs a program, writes out what it has printed, and says on stderr what ends it instead: nothing
/// is thrown. `smaller` is what to try where memory runs out: "a smaller …".
ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller);

/// frontend::render, or another with its contract.
using Renderer = std::function<csgcore::Image(const csgcore::Scene&, const csgcore::View&,
                                              const RenderSettings&, RenderStats&)>;

/// Runs the command; where the first argument is `bench` or `validate`, the program scadray-bench
/// or scadray-validate in this one's place. Messages go to stderr; nothing is thrown.
ExitCode run_command(const std::vector<std::string>& arguments, const Renderer& renderer);

}  // namespace frontend
