// What the window remembers, and files that are dropped on it.
#include <filesystem>
#include <utility>

#include "application.hpp"
#include "memory.hpp"
#include "process/spawn.hpp"

namespace window {

/// Notes what the user has changed, and writes it once it has settled.
void Application::remember() {
  const Clock::time_point now = Clock::now();
  if (window_.take_placement_change()) memory_.touch(now);
  memory_.note(habits_of(state_), now);
  if (const auto due = memory_.due(); due && now >= *due) write_memory();
}

void Application::write_memory() {
  memory_.note(values_of(window_.placement(), memory_.is_only_window()), Clock::now());
  memory_.write();
}

/// Opens the first file here, and each other one in a window of its own.
void Application::drop(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  opening_ = paths[0];
  std::error_code failed;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", failed).string();
  for (std::size_t i = 1; i < paths.size(); ++i) {
    try {
      frontend::start_program({program, "--", paths[i]}, [](int) {});
    } catch (const std::system_error& error) {
      state_.notice = program + " cannot be started: " + error.code().message();
    }
  }
}

}  // namespace window
