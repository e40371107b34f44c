// Cleans up when a signal ends the program.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cstddef>

namespace frontend {

/// Installs the handlers. From then on no signal but SIGKILL ends the program before the registered
/// files are removed and the registered process groups are killed. A signal that asks for the end
/// (SIGINT, SIGTERM, SIGHUP, SIGXCPU, …) then gives exit code 1; one that dumps core (SIGQUIT, a
/// crash) still does so. SIGPIPE and SIGXFSZ are ignored, so that writing fails with an error.
/// Signals that the parent process has set to be ignored stay ignored. To be called once, by a
/// program's main.
void handle_interrupts();

/// The most files that can be registered at once. Each has a slot, since the handler may not
/// allocate.
constexpr std::size_t kMaxRemovedFiles = 4098;

/// While this object lives, an interruption removes the file at `path`. The characters behind
/// `path` must live as long. Throws Error if too many files are registered.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const char* path);
  ~RemoveOnInterrupt();
  RemoveOnInterrupt(const RemoveOnInterrupt&) = delete;
  RemoveOnInterrupt& operator=(const RemoveOnInterrupt&) = delete;

 private:
  std::size_t slot_;
};

/// The most process groups that can be registered at once.
constexpr std::size_t kMaxChildGroups = 64;

/// While this object lives, an interruption kills the process group that it is given. Throws Error
/// if too many are registered.
class KillOnInterrupt {
 public:
  KillOnInterrupt();
  ~KillOnInterrupt();
  KillOnInterrupt(const KillOnInterrupt&) = delete;
  KillOnInterrupt& operator=(const KillOnInterrupt&) = delete;
  /// 0 means no group.
  void set(pid_t group);

 private:
  std::size_t slot_;
};

/// Guards work that must not be left half done. While this object lives, an interruption waits for
/// its end, for some seconds at most, and this thread takes no signal. Crashes and SIGKILL do not
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
