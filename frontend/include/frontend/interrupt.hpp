// What is to be undone when a signal ends the program.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstddef>

namespace frontend {

/// From here on no signal but SIGKILL ends the program before the registered files are removed and
/// the registered process group is killed. A signal that asks for the end (SIGINT, SIGTERM, SIGHUP,
/// SIGXCPU, …) then gives exit code 1; one that dumps core (SIGQUIT, a crash) does so all the same.
/// SIGPIPE and SIGXFSZ are ignored: writing then fails with an error. Signals that the caller
/// ignores stay ignored. To be called once, by a program's main.
void handle_interrupts();

/// So many files can be registered at once: each has a slot, for the handler may not allocate.
constexpr std::size_t kMaxRemovedFiles = 4098;

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

/// The process group that an interruption kills; 0: none. Only one runs at a time.
void set_child_group(pid_t group);

/// For what must not be left half done: while this object lives, an interruption waits for its end,
/// for some seconds at most. This thread takes no signal until then. Crashes and SIGKILL do not
/// wait.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;
  /// The signals that this thread had blocked before.
  const sigset_t& blocked_before() const { return before_; }

 private:
  sigset_t before_;
};

}  // namespace frontend
