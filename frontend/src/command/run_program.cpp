#include "frontend/run_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
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

bool print_requested(ProgramRequest request, const std::string& help, const std::string& version) {
  if (request == ProgramRequest::kWork) return false;
  std::fputs(request == ProgramRequest::kHelp ? help.c_str() : (version + "\n").c_str(), stdout);
  return true;
}

void run_subcommand(const std::string& name, const std::vector<std::string>& arguments,
                    const std::string& todo) {
  // The path is the program's own, not the one it was called by, which may be a link in another
  // folder.
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  std::string program = self.parent_path() / ("scadray-" + name);
  std::vector<char*> words{program.data()};
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));  // execv's signature demands it; execv
                                                           // does not write
  }
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  if (errno == ENOENT) {
    throw Error("", {}, "this scadray has no `" + name + "`: " + program + " is not there", todo);
  }
  throw Error(program, {}, std::string("cannot be run: ") + std::strerror(errno),
              "check its permissions");
}

}  // namespace frontend
