// The program that `scadray FILE` executes where there is no -o: the live window.
#include <cstdio>
#include <exception>

#include "application.hpp"
#include "frontend/command.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"

namespace {

void run(const std::vector<std::string>& arguments) {
  const frontend::Options options = frontend::parse_options(arguments);
  if (options.action != frontend::Action::kOpenWindow) {
    throw frontend::Error("", {}, "scadray-window only opens a window", "run scadray");
  }
  if (!options.quiet) {
    for (const std::string& warning : options.warnings) {
      std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
  }
  window::Application(options).run();
}

}  // namespace

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  try {
    run({argv + (argc > 0 ? 1 : 0), argv + argc});
    return static_cast<int>(frontend::ExitCode::kDone);
  } catch (const frontend::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  return static_cast<int>(frontend::ExitCode::kFailure);
}
