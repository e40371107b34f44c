#include "process/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "frontend/interrupt.hpp"
#include "process/spawn.hpp"

namespace frontend {

Pipe::Pipe() {
  if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "a pipe cannot be made");
  }
}

ChildProcess::ChildProcess(const ChildSetup& setup) {
  FileActions files;
  if (setup.input >= 0) {
    files.give(setup.input, STDIN_FILENO);
  } else {
    files.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  }
  files.give(setup.output, STDOUT_FILENO);
  files.give(setup.errors, STDERR_FILENO);
  if (setup.kept >= 0) files.give(setup.kept, setup.kept);

  FileActions guard_files;
  guard_files.give(lifeline_.read_end(), STDIN_FILENO);
  guard_files.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
  guard_files.open(STDERR_FILENO, "/dev/null", O_WRONLY);

  // The group must be registered before an interruption can come, once anything runs. The guard
  // starts second, as nothing waits for it.
  const HoldInterrupts hold;
  pid_ = group_ = spawn(setup.command, files, 0, hold);
  interrupt_.set(group_);
  try {
    guard_ = spawn({"/bin/sh", "-c", "read end; kill -KILL 0"}, guard_files, group_, hold);
  } catch (...) {
    kill_all();
    wait();
    throw;
  }
  lifeline_.close_read_end();
  // glibc 2.36 declares pidfd_open() for C only.
  end_.reset(static_cast<int>(syscall(SYS_pidfd_open, pid_, 0)));
}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0) return;
  kill_all();
  wait();
}

bool ChildProcess::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid != 0;
}

int ChildProcess::wait() {
  siginfo_t info{};
  while (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  kill(-group_, SIGKILL);  // the guard, and whatever else is left
  interrupt_.set(0);       // as long as no other group can have the number
  int status = 0;
  waitpid(std::exchange(pid_, 0), &status, 0);
  if (guard_ > 0) waitpid(std::exchange(guard_, 0), nullptr, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void ChildProcess::kill_all() const {
  kill(-group_, SIGKILL);
  kill(pid_, SIGKILL);  // in case it has left the group
}

}  // namespace frontend
