#include "process/spawn.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "frontend/interrupt.hpp"

extern char** environ;

namespace frontend {

pid_t spawn(std::vector<std::string> command, const FileActions& files, std::optional<pid_t> group,
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
                           static_cast<short>((group ? POSIX_SPAWN_SETPGROUP : POSIX_SPAWN_SETSID) |
                                              POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK));
  posix_spawnattr_setpgroup(&attributes, group.value_or(0));
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setsigmask(&attributes, &hold.blocked_before());
  pid_t pid = 0;
  const int failed =
      posix_spawnp(&pid, arguments[0], files.get(), &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), command[0]);
  return pid;
}

void start_program(const std::vector<std::string>& command,
                   std::function<void(int exit_code)> on_end) {
  FileActions files;
  files.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  files.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
  files.open(STDERR_FILENO, "/dev/null", O_WRONLY);
  const HoldInterrupts hold;
  const pid_t pid = spawn(command, files, std::nullopt, hold);
  std::thread([pid, end = std::move(on_end)] {
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    end(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  }).detach();
}

}  // namespace frontend
