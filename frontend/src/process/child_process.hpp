// Runs a program, with everything that it starts, so that it never outlives this one.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "base/descriptor.hpp"
#include "frontend/interrupt.hpp"

namespace frontend {

/// A pipe that closes its open ends when it is destroyed. No program inherits it.
class Pipe {
 public:
  /// Throws std::system_error.
  Pipe();
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_read_end() { close_end(0); }
  void close_write_end() { close_end(1); }

 private:
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

struct ChildSetup {
  std::vector<std::string> command;  // the program, looked up on PATH, and its arguments
  int output = -1;                   // its standard output
  int errors = -1;                   // its standard error
  int kept = -1;                     // one more descriptor that it inherits, with the same number;
                                     // -1: none
  int input = -1;                    // its standard input; -1: empty
};

/// A running program. It and everything that it starts are in a process group of their own. The
/// group is killed when this object is destroyed, when a signal ends this program (interrupt.hpp),
/// and when this program is killed. For the last case the group holds a guard: a shell that waits
/// for the end of a pipe that only this program holds open, and then kills its own group.
/// (PR_SET_PDEATHSIG would reach the program alone, not what a wrapper script has started.)
class ChildProcess {
 public:
  /// Starts the program. Throws std::system_error if it cannot be
  /// started.
  explicit ChildProcess(const ChildSetup& setup);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// A descriptor that is readable once the program has ended; -1 where the system has none (Linux
  /// before 5.3).
  int end_descriptor() const { return end_.number(); }
  bool has_ended() const;
  /// Waits for the program's end, kills what it has left running, and returns its exit code, or 128
  /// plus the number of the signal that ended it.
  int wait();

 private:
  void kill_all() const;

  KillOnInterrupt interrupt_;
  Pipe lifeline_;  // from here to the guard; nothing is written to it
  pid_t pid_ = 0;
  pid_t group_ = 0;
  pid_t guard_ = 0;
  Descriptor end_{-1};
};

}  // namespace frontend
