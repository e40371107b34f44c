// Other programs, run and measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace measure {

struct ProcessResult {
  /// Its exit status; none if it was ended by a signal or ran past the limit.
  std::optional<int> status;
  bool timed_out = false;
  double wall_ms = 0;  // from before its start until its end
  double cpu_ms = 0;   // of all its threads and of those children that it waited for
  /// Of memory, of the largest of them; never below what this program holds at the start of it.
  uint64_t peak_bytes = 0;
  std::string output;  // stdout and stderr, the last 64 KiB
  bool succeeded() const { return status == 0; }
};

struct ProcessOptions {
  double limit_s = 60;                     // with all its children it is killed then
  std::filesystem::path folder{};          // it works in; empty: this program's
  std::vector<std::string> environment{};  // "NAME=value", besides this program's
};

/// Runs the program, found by PATH, with these arguments, and waits for its end.
/// Throws std::system_error where no process can be started; a program that is not found has
/// status 127.
ProcessResult run_process(const std::vector<std::string>& command,
                          const ProcessOptions& options = {});

/// Where PATH has the program; empty where it has not.
std::filesystem::path find_program(const std::string& name);

}  // namespace measure
