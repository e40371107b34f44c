// What --stats writes of the live window: one line of JSON for each picture that stands.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "state.hpp"

namespace window {

class Report {
 public:
  /// `path` empty: nothing is written; "-": standard output. Throws frontend::Error where the file
  /// cannot be written.
  explicit Report(const std::string& path);

  /// Of the picture that is on the screen. `save_to_screen_ms`: since the save that led to it was
  /// noticed; below 0: none did.
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
