#include "process/openscad_program.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "process/memory_file.hpp"

namespace frontend {
namespace {

bool is_on_path(const std::string& program) {
  const char* const folders = std::getenv("PATH");
  std::istringstream rest(folders ? folders : "");
  for (std::string folder; std::getline(rest, folder, ':');) {
    const std::string path = (folder.empty() ? "." : folder) + "/" + program;
    if (access(path.c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

std::string openscad_program() {
  for (const char* variable : {"SCADRAY_OPENSCAD", "OPENSCAD"}) {
    const char* const name = std::getenv(variable);
    if (name && *name) return name;
  }
  constexpr const char* kSnapshot = "openscad-nightly";
  return is_on_path(kSnapshot) ? kSnapshot : "openscad";
}

ChildProcess start_openscad(const ChildSetup& setup, const std::string& need,
                            const std::string& otherwise) {
  try {
    return ChildProcess(setup);
  } catch (const std::system_error& error) {
    const std::string& program = setup.command[0];
    if (error.code().value() == ENOENT) {
      throw Error("", {}, need + ", and " + program + " was not found",
                  "install it, with: apt-get install openscad; or name it in $SCADRAY_OPENSCAD" +
                      otherwise);
    }
    throw Error("", {}, program + " cannot be run: " + std::strerror(error.code().value()),
                "check $SCADRAY_OPENSCAD, $OPENSCAD and PATH");
  }
}

std::string said_by_openscad(const std::vector<std::string>& arguments) {
  const MemoryFile said;
  std::vector<std::string> command = {openscad_program()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  start_openscad({.command = command, .output = said.descriptor(), .errors = said.descriptor()},
                 "designs are compared with OpenSCAD's")
      .wait();
  if (lseek(said.descriptor(), 0, SEEK_SET) != 0) return {};
  return std::string(read_descriptor(said.descriptor(), "a file in memory").view());
}

std::vector<std::string> known_to_openscad(
    const std::vector<std::string>& options,
    const std::function<void(const std::string& line)>& warn) {
  const auto is_long = [](const std::string& word) { return word.starts_with("--"); };
  if (std::none_of(options.begin(), options.end(), is_long)) return options;
  std::string help;
  try {
    help = said_by_openscad({"--help"});
  } catch (const Error&) {
    return options;  // as will be said where it is started
  }
  std::replace(help.begin(), help.end(), '\n', ' ');
  if (help.find("--help ") == std::string::npos) return options;  // it does not tell
  std::vector<std::string> known;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::string name = options[i].substr(0, options[i].find('='));
    if (!is_long(name)) {
      known.insert(known.end(), options.begin() + static_cast<long>(i),
                   options.begin() + static_cast<long>(std::min(i + 2, options.size())));
      ++i;
    } else if (help.find(name + " ") != std::string::npos) {
      known.push_back(options[i]);
    } else {
      warn("warning: " + openscad_program() + " does not know " + name + ", and is not given it");
    }
  }
  return known;
}

}  // namespace frontend
