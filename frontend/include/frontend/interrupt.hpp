// What is to be undone when a signal ends the program.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace frontend {

/// From here on SIGINT, SIGTERM and SIGHUP remove the registered files, kill the registered child
/// and end the program with exit code 1; SIGPIPE is ignored (writing then fails with an error).
/// Signals that the caller ignores stay ignored. To be called once, by a program's main.
void handle_interrupts();

/// The file at `path` is removed at an interruption while this object lives. The text behind
/// `path` must live as long. Throws Error if too many are registered.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const char* path);
  ~RemoveOnInterrupt();
  RemoveOnInterrupt(const RemoveOnInterrupt&) = delete;
  RemoveOnInterrupt& operator=(const RemoveOnInterrupt&) = delete;

 private:
  std::size_t slot_;
};

/// The process group that an interruption kills; 0: none. Only one child runs at a time.
void set_child_group(pid_t group);

/// A group that is about to be known: an interruption waits for it. The thread that says so blocks
/// all signals until it has said which it is.
constexpr pid_t kStartingChild = -1;

}  // namespace frontend
