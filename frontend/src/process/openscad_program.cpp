#include "process/openscad_program.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace frontend {
namespace {

/// Returns the path of the program as PATH has it; empty if it is not there.
std::string on_path(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/bin:/usr/bin";
  for (;;) {
    const std::size_t end = rest.find(':');
    std::string folder(rest.substr(0, end));
    std::string candidate = (folder.empty() ? "." : std::move(folder)) + '/' + program;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
    if (end == std::string_view::npos) return {};
    rest.remove_prefix(end + 1);
  }
}

}  // namespace

std::string openscad_program() {
  const char* name = std::getenv("OPENSCAD");
  return name && *name ? name : "openscad";
}

std::string openscad_identity() {
  const std::string path = on_path(openscad_program());
  struct stat status {};
  if (path.empty() || stat(path.c_str(), &status) != 0) return {};
  return path + ' ' + std::to_string(status.st_size) + ' ' + std::to_string(status.st_mtim.tv_sec) +
         '.' + std::to_string(status.st_mtim.tv_nsec);
}

}  // namespace frontend
