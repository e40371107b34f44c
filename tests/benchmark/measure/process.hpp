// Runs and measures other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace measure {

struct ProcessResult {
  /// Its exit status; nothing if a signal ended it, or it ran past the limit.
  std::optional<int> status;
  bool timed_out = false;
  double wall_ms = 0;  // from before its start until its end
  double cpu_ms = 0;   // of all its threads and of those children that it waited for
  /// The peak memory of the largest of these processes. It is at least what this program holds at
  /// their start.
  uint64_t peak_bytes = 0;
  std::string output;  // stdout and stderr, the last 64 KiB
  bool succeeded() const { return status == 0; }
};

struct ProcessOptions {
  double limit_s = 60;                     // then it is killed, with all its children
  std::filesystem::path folder{};          // the folder it works in; empty: this program's
  std::vector<std::string> environment{};  // "NAME=value", besides this program's
};

/// Runs the program, found by PATH, with these arguments, and waits for its end. Throws
/// std::system_error if no process can be started; a program that is not found has status 127.
ProcessResult run_process(const std::vector<std::string>& command,
                          const ProcessOptions& options = {});

/// Returns the program's path, found by PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name);

}  // namespace measure
