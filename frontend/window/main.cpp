// The live window: the program that `scadray FILE` executes if there is no -o.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <vector>

#include "application.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/run_program.hpp"
#include "frontend/terminal.hpp"

namespace {

using frontend::ExitCode;

/// Processes that show the other designs. They end with this one, unless it waits for them.
class OtherWindows {
 public:
  OtherWindows() = default;
  ~OtherWindows() { wait(); }
  OtherWindows(const OtherWindows&) = delete;
  OtherWindows& operator=(const OtherWindows&) = delete;

  /// Returns true in this process, and false in a new one. Precondition: this one has a single
  /// thread and no window.
  bool add() {
    const pid_t parent = getpid(), child = fork();
    if (child < 0) throw frontend::Error("", {}, "no process for another window", "open fewer");
    if (child > 0) {
      pids_.push_back(child);
      return true;
    }
    pids_.clear();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    return false;
  }

  /// Returns the worst of their exit codes.
  ExitCode wait() {
    ExitCode code = ExitCode::kDone;
    for (const pid_t pid : pids_) {
      int status = 0;
      while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
      }
      if (status != 0) code = ExitCode::kFailure;
    }
    pids_.clear();
    return code;
  }

 private:
  std::vector<pid_t> pids_;
};

ExitCode run(const std::vector<std::string>& arguments) {
  frontend::Options options = frontend::parse_options(arguments);
  if (options.action != frontend::Action::kOpenWindow) {
    throw frontend::Error("", {}, "scadray-window only opens a window", "run scadray");
  }
  if (!options.stats_path.empty()) {
    const frontend::NamedPath stats{"--stats", options.stats_path};
    frontend::check_outputs_differ(
        {&stats, 1}, frontend::design_inputs(options.input, options.openscad_arguments));
  }
  if (!options.quiet) {
    for (const std::string& warning : options.warnings) {
      frontend::print_text(stderr, "warning: " + warning + "\n");
    }
  }
  OtherWindows others;
  for (const std::string& input : options.further_inputs) {
    if (others.add()) continue;
    options.input = input;
    break;
  }
  window::Application(options).run();
  return others.wait();
}

}  // namespace

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const auto program = [&] { return run(arguments); };
  return static_cast<int>(frontend::run_program(program, "a smaller --imgsize or design"));
}
