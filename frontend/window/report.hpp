// Writes --stats of the live window: one line of JSON for each final picture.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "state.hpp"

namespace window {

class Report {
 public:
  /// With an empty `path` nothing is written; "-" is standard output. Throws frontend::Error if the
  /// file cannot be written.
  explicit Report(const std::string& path);

  /// Reports the picture that is on the screen. `save_to_screen_ms` is the time since the notice of
  /// the save that led to it; below 0: no save did.
  void write(const State& state, double save_to_screen_ms);

 private:
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace window
