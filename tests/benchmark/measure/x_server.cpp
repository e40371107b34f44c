#include "x_server.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace measure {
namespace {

constexpr int kStartLimit_ms = 20'000;
/// The descriptor to which Xvfb writes the number that it has chosen.
constexpr int kAnswer = 3;

/// Reads up to the end of a line; empty if none comes in time.
std::string read_line(int pipe) {
  std::string line;
  for (;;) {
    pollfd waiting{pipe, POLLIN, 0};
    char letter = 0;
    if (poll(&waiting, 1, kStartLimit_ms) <= 0 || ::read(pipe, &letter, 1) != 1) return {};
    if (letter == '\n') return line;
    line += letter;
  }
}

}  // namespace

XServer::XServer() {
  int pipe[2];
  if (pipe2(pipe, O_CLOEXEC) != 0) return;
  // The number is beyond kAnswer, so that dup2 makes a descriptor that exec keeps.
  const int writing = fcntl(pipe[1], F_DUPFD_CLOEXEC, kAnswer + 1);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, writing, kAnswer);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string words[] = {"Xvfb",      "-displayfd", std::to_string(kAnswer),
                         "-screen",   "0",          "1280x1024x24",
                         "-nolisten", "tcp"};
  char* arguments[std::size(words) + 1] = {};
  for (size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
  const int failed = posix_spawnp(&process_, "Xvfb", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(writing);
  close(pipe[1]);
  if (failed != 0) process_ = 0;
  if (process_ > 0) {
    const std::string number = read_line(pipe[0]);
    if (!number.empty()) display_ = ":" + number;
  }
  close(pipe[0]);
}

XServer::~XServer() {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

}  // namespace measure
