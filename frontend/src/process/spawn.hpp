// How programs are started: none inherits what this program has changed for itself.
#pragma once

#include <spawn.h>
#include <sys/types.h>

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

}  // namespace frontend
