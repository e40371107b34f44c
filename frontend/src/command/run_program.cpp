#include "frontend/run_program.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "frontend/error.hpp"
#include "frontend/terminal.hpp"

namespace frontend {

ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller) {
  try {
    const ExitCode code = program();
    if (std::fflush(stdout) != 0) throw Error("", {}, "standard output cannot be written", "");
    return code;
  } catch (const Error& error) {
    print_text(stderr, error.what() + std::string("\n"));
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "error: out of memory (try %s)\n", smaller.c_str());
  } catch (const std::exception& error) {
    print_text(stderr, "error: " + std::string(error.what()) + "\n");
  }
  return ExitCode::kFailure;
}

}  // namespace frontend
