// The live window: the program that `scadray FILE` executes if there is no -o.
#include <cstdio>

#include "application.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/run_program.hpp"
#include "frontend/terminal.hpp"

namespace {

void run(const std::vector<std::string>& arguments) {
  const frontend::Options options = frontend::parse_options(arguments);
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
  window::Application(options).run();
}

}  // namespace

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const auto program = [&] {
    run(arguments);
    return frontend::ExitCode::kDone;
  };
  return static_cast<int>(frontend::run_program(program, "a smaller --imgsize or design"));
}
