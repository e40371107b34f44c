#include "display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace window_test {
namespace {

/// Windows have no frame, beside which xdotool would look for them, and are in the upper left
/// corner. The close button has its usual key.
constexpr const char* kManagerSettings = R"(<?xml version="1.0" encoding="UTF-8"?>
<openbox_config xmlns="http://openbox.org/3.4/rc">
  <theme><keepBorder>no</keepBorder></theme>
  <keyboard><keybind key="A-F4"><action name="Close"/></keybind></keyboard>
  <applications>
    <application class="*">
      <decor>no</decor>
      <position force="yes"><x>0</x><y>0</y></position>
    </application>
  </applications>
</openbox_config>
)";

}  // namespace

Display::Display() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  ProcessSetup setup;
  // A server that stays when its last client goes, and whose pictures are without the pointer.
  setup.words = {"Xvfb",     "-displayfd", "3",         "-screen", "0",      "1280x1024x24",
                 "-noreset", "-nocursor",  "-nolisten", "tcp",     "-fbdir", folder_.path()};
  setup.errors = folder_ / "errors";
  setup.descriptor = ends[1];
  server_ = std::make_unique<Process>(setup);
  close(ends[1]);
  std::string number;
  char byte = 0;
  pollfd waits{ends[0], POLLIN, 0};
  constexpr std::chrono::milliseconds kMost = kPatience;
  while (poll(&waits, 1, static_cast<int>(kMost.count())) == 1 && read(ends[0], &byte, 1) == 1 &&
         byte != '\n') {
    number += byte;
  }
  close(ends[0]);
  if (number.empty()) throw std::runtime_error("Xvfb does not start: " + folder_.read("errors"));
  name_ = ":" + number;
}

Picture Display::screenshot() const { return read_xwd(folder_ / "Xvfb_screen0"); }

std::string Display::drive(std::vector<std::string> words) const {
  ProcessSetup setup;
  setup.words = std::move(words);
  setup.words.insert(setup.words.begin(), "xdotool");
  setup.environment["DISPLAY"] = name_;
  return run(setup);
}

void Display::start_window_manager() {
  ProcessSetup setup;
  setup.words = {"openbox", "--sm-disable", "--config-file",
                 folder_.write("rc.xml", kManagerSettings)};
  setup.environment = {{"DISPLAY", name_}, {"HOME", folder_.path()}};
  manager_ = std::make_unique<Process>(setup);
  const bool is_there = wait_until([this] {
    ProcessSetup question;
    question.words = {"xdotool", "get_desktop"};  // a window manager keeps it
    question.environment["DISPLAY"] = name_;
    return Process(question).wait() == 0;
  });
  if (!is_there) throw std::runtime_error("openbox does not start");
}

}  // namespace window_test
