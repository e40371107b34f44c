#include "child_process.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <sstream>
#include <string_view>
#include <system_error>

namespace oracle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLongestWait{50};

bool write_all(int out, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(out, text.data(), text.size());
    if (n < 0 && errno != EINTR) return false;
    text.remove_prefix(n > 0 ? static_cast<size_t>(n) : 0);
  }
  return true;
}

[[noreturn]] void be_child(const std::function<void(std::ostream&)>& work, int out, pid_t parent) {
  // The parent's signal handlers must not run in the child.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // the parent ended before the line above
  try {
    std::ostringstream text;
    work(text);
    _exit(write_all(out, text.view()) ? 0 : 1);
  } catch (const std::exception& error) {
    write_all(out, error.what());
  } catch (...) {
  }
  _exit(1);
}

/// Reads all output of the child. Returns kBuilt at its end.
NefStatus read_all(int in, const NefLimits& limits, std::string& text) {
  char buffer[1 << 16];
  for (;;) {
    if (!limits.keep_waiting()) return NefStatus::kCancelled;
    const Clock::time_point now = Clock::now();
    if (now >= limits.deadline) return NefStatus::kDeadline;
    const auto wait = std::min<Clock::duration>(limits.deadline - now, kLongestWait);
    pollfd watched{in, POLLIN, 0};
    const auto wait_ms = std::chrono::ceil<std::chrono::milliseconds>(wait).count();
    if (poll(&watched, 1, static_cast<int>(wait_ms)) <= 0) continue;
    const ssize_t n = read(in, buffer, sizeof buffer);
    if (n == 0) return NefStatus::kBuilt;
    if (n > 0) text.append(buffer, static_cast<size_t>(n));
    if (n < 0 && errno != EINTR) return NefStatus::kFailed;
  }
}

}  // namespace

ChildOutput run_in_child(const std::function<void(std::ostream&)>& work, const NefLimits& limits) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    be_child(work, ends[1], parent);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  ChildOutput output;
  output.status = read_all(ends[0], limits, output.text);
  close(ends[0]);
  if (output.status != NefStatus::kBuilt) kill(child, SIGKILL);
  int state = 0;
  while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  const bool ended_well = WIFEXITED(state) && WEXITSTATUS(state) == 0;
  if (output.status == NefStatus::kBuilt && !ended_well) {
    output.status = NefStatus::kFailed;
    if (output.text.empty()) output.text = "the process ended";
  }
  return output;
}

}  // namespace oracle
