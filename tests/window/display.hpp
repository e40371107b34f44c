// An X display of its own for a test, without a screen (Xvfb), and the hand at its mouse and keys
// (xdotool).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "picture.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace window_test {

/// Its screen is 1280×1024 pixels. Throws std::runtime_error if it does not start.
class Display {
 public:
  Display();

  /// The value of the environment's DISPLAY.
  const std::string& name() const { return name_; }
  /// All that the screen shows now; the mouse's pointer is not drawn.
  Picture screenshot() const;
  /// A command of xdotool's, or several; its output.
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
