// slow_search [--seed=N] [--seconds=S] [--designs=N] [--limit=S] [--threshold=MS] PROGRAM FOLDER
//             [START.csg…]
#include <signal.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string_view>

#include "search.hpp"

namespace {

namespace fs = std::filesystem;

volatile sig_atomic_t is_interrupted = 0;

/// A picture may take no more memory than this; what tries fails, or is ended by a signal.
[[maybe_unused]] constexpr rlim_t kMostMemory = rlim_t{8} << 30;

/// The value in "--name=value".
double number_of(const std::string& option) {
  const char* const text = option.c_str() + option.find('=') + 1;
  char* end = nullptr;
  errno = 0;
  const double number = std::strtod(text, &end);
  if (end == text || *end != 0 || errno != 0 || !(number >= 0) || number > 1e9) {
    throw std::runtime_error(option + " is not understood (give a number from 0 to 1e9)");
  }
  return number;
}

struct Command {
  slow_search::Settings settings;
  fs::path folder;
};

Command command_of(int count, char** words) {
  Command command;
  std::vector<std::string> files;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const std::string name = word.substr(0, word.find('='));
    if (!word.starts_with("--")) {
      files.push_back(word);
    } else if (name == "--seed") {
      command.settings.seed = static_cast<uint64_t>(number_of(word));
    } else if (name == "--seconds") {
      command.settings.seconds = number_of(word);
    } else if (name == "--designs") {
      command.settings.designs = static_cast<uint64_t>(number_of(word));
    } else if (name == "--limit") {
      command.settings.limit_s = number_of(word);
    } else if (name == "--threshold") {
      command.settings.threshold_ms = number_of(word);
    } else {
      throw std::runtime_error(word +
                               " is not understood (give --seed=N, --seconds=S, "
                               "--designs=N, --limit=S or --threshold=MS)");
    }
  }
  if (files.size() < 2) {
    throw std::runtime_error("nothing to search with (give PROGRAM FOLDER [START.csg...])");
  }
  command.settings.program = fs::absolute(files[0]);
  command.folder = files[1];
  command.settings.starts.assign(files.begin() + 2, files.end());
  return command;
}

void run(Command command) {
  fs::create_directories(command.folder);
  if (!fs::is_empty(command.folder)) {
    throw std::runtime_error(command.folder.string() + " is not empty (give a new folder)");
  }
  command.settings.goes_on = [] { return is_interrupted == 0; };
  command.settings.say = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  const slow_search::Result result = slow_search::search(command.settings);
  slow_search::write(result, command.settings, command.folder);
  std::printf("%s\n", (command.folder / "found.txt").c_str());
}

}  // namespace

int main(int count, char** words) {
  struct sigaction action {};
  action.sa_handler = [](int) { is_interrupted = 1; };
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
#if !defined(SCADRAY_SANITIZED)  // sanitizers reserve terabytes
  const rlimit memory{kMostMemory, kMostMemory};
  setrlimit(RLIMIT_AS, &memory);
#endif
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    run(command_of(count, words));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
