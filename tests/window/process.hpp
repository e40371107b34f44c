// A program that a test starts, drives and ends.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace window_test {

/// Far longer than anything waited for takes, on a slow machine and under a sanitizer.
constexpr std::chrono::seconds kPatience{60};

/// Whether it came true in time.
template <typename Condition>
bool wait_until(const Condition& is_true) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_true()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// The first of these programs that the machine lacks.
std::optional<std::string> missing_program(const std::vector<std::string>& names);

struct ProcessSetup {
  std::vector<std::string> words;                                 // the program, and its arguments
  std::map<std::string, std::optional<std::string>> environment;  // none: not set
  std::string input = "/dev/null";                                // standard input's file
  std::string output = "/dev/null";                               // standard output's
  std::string errors = "/dev/null";                               // standard error's
  int descriptor = -1;                                            // handed on as number 3; -1: none
};

/// Killed, at the latest, when this object or the test itself ends.
class Process {
 public:
  explicit Process(const ProcessSetup& setup);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal_number) const;
  /// Its exit status; 128 + the signal that ended it; -1 if it does not end.
  int wait();
  /// If it ended by itself, its status.
  std::optional<int> ended();

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Runs a program to its end; its standard output. A failure is reported as one of the test.
std::string run(ProcessSetup setup);

/// Of a running process, from /proc.
std::size_t open_descriptors(pid_t pid);
std::size_t resident_bytes(pid_t pid);
/// Processor time in clock ticks, of all its threads.
long used_ticks(pid_t pid);
/// Processes that it started and that it has not waited for.
std::size_t children(pid_t pid);
/// Zombies that nobody has waited for yet do not count.
bool is_running(pid_t pid);

}  // namespace window_test
