#include "frontend/run_program.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "frontend/error.hpp"

namespace frontend {

ExitCode run_program(const std::function<ExitCode()>& program, const std::string& smaller) {
  try {
    const ExitCode code = program();
    if (std::fflush(stdout) != 0) throw Error("", {}, "standard output cannot be written", "");
    return code;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "error: out of memory (try %s)\n", smaller.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  return ExitCode::kFailure;
}

}  // namespace frontend
