// How programs are started: none inherits what this program has changed for itself.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frontend/interrupt.hpp"

namespace frontend {

/// Owns posix_spawn's file actions.
class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  void open(int number, const char* path, int flags) {
    posix_spawn_file_actions_addopen(&actions_, number, path, flags, 0);
  }
  /// A descriptor that is given its own number stays open in the child.
  void give(int descriptor, int number) {
    posix_spawn_file_actions_adddup2(&actions_, descriptor, number);
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// Starts a program, looked up on PATH, in a process group (0: one of its own), with the signals
/// set as they were before this program changed them. Without a group it gets a session of its own,
/// without a terminal. Throws std::system_error.
pid_t spawn(std::vector<std::string> command, const FileActions& files, std::optional<pid_t> group,
            const HoldInterrupts& hold);

/// Starts a program that goes its own way, as an editor does, looked up on PATH, with its
/// arguments. It may outlive this program, gets no terminal, an empty standard input, and no
/// outputs. Its end is waited for in a thread of its own, from which `on_end` is called with its
/// exit code, or 128 plus the number of the signal that ended it; or never, if this program ends
/// first. Throws std::system_error if it cannot be started.
void start_program(const std::vector<std::string>& command,
                   std::function<void(int exit_code)> on_end);

}  // namespace frontend
