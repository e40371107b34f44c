// An X display for one test, without a screen (Xvfb), with its mouse and keys driven by xdotool.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "picture.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace window_test {

/// A display with a screen of 1280×1024 pixels. Throws std::runtime_error if it does not start.
class Display {
 public:
  Display();

  /// The value for the variable DISPLAY.
  const std::string& name() const { return name_; }
  /// Returns all that the screen shows now, without the mouse's pointer.
  Picture screenshot() const;
  /// Runs one or several commands of xdotool, and returns the output.
  std::string drive(std::vector<std::string> words) const;
  /// Starts openbox, and waits until it manages windows.
  void start_window_manager();

 private:
  frontend::TemporaryFolder folder_;
  std::unique_ptr<Process> server_;
  std::string name_;
  std::unique_ptr<Process> manager_;
};

}  // namespace window_test
