#include "frontend/subcommand.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "frontend/error.hpp"

namespace frontend {

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
