#include "process/start_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <thread>
#include <utility>

#include "frontend/interrupt.hpp"
#include "process/spawn.hpp"

namespace frontend {

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
