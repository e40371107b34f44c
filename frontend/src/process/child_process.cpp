#include "process/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "frontend/interrupt.hpp"

extern char** environ;

namespace frontend {
namespace {

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

/// Starts a program in a process group (0: one of its own), with the signals set as they were
/// before this program changed them. Throws std::system_error.
pid_t spawn(std::vector<std::string> command, const FileActions& files, pid_t group,
            const HoldInterrupts& hold) {
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) {
    sigaddset(&defaults, number);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, group);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &hold.blocked_before());
  pid_t pid = 0;
  const int failed =
      posix_spawnp(&pid, arguments[0], files.get(), &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), command[0]);
  return pid;
}

}  // namespace

Pipe::Pipe() {
  if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "a pipe cannot be made");
  }
}

ChildProcess::ChildProcess(const ChildSetup& setup) {
  FileActions files;
  files.open(STDIN_FILENO, "/dev/null", O_RDONLY);
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
  constexpr int kLeastPriority = 19;
  if (setup.is_in_background) setpriority(PRIO_PGRP, static_cast<id_t>(group_), kLeastPriority);
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
