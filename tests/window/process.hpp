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

/// Far longer than anything that tests wait for, on a slow machine and under a sanitizer.
constexpr std::chrono::seconds kPatience{60};

/// Waits until the condition holds; returns whether it did in time.
template <typename Condition>
bool wait_until(const Condition& is_true) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_true()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// Returns the first of these programs that the machine does not have.
std::optional<std::string> missing_program(const std::vector<std::string>& names);

struct ProcessSetup {
  std::vector<std::string> words;                                 // the program and its arguments
  std::map<std::string, std::optional<std::string>> environment;  // nothing: the variable is
                                                                  // removed
  std::string input = "/dev/null";                                // standard input's file
  std::string output = "/dev/null";                               // standard output's
  std::string errors = "/dev/null";                               // standard error's
  int descriptor = -1;                                            // passed on as number 3; -1: none
};

/// A process, which is killed when this object or the test itself ends, at the latest.
class Process {
 public:
  explicit Process(const ProcessSetup& setup);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal_number) const;
  /// Returns its exit status; 128 + the signal that ended it; -1 if it does not end.
  int wait();
  /// Returns its status if it has ended by itself.
  std::optional<int> ended();

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Runs a program to its end, and returns its standard output. Its failure is a failure of the
/// test.
std::string run(ProcessSetup setup);

/// The number of a running process's open descriptors, from /proc.
std::size_t open_descriptors(pid_t pid);
std::size_t resident_bytes(pid_t pid);
/// The processor time of all threads of a process, in clock ticks.
long used_ticks(pid_t pid);
/// The number of processes that it has started and not yet waited for.
std::size_t children(pid_t pid);
/// Zombies that nobody has waited for yet do not count.
bool is_running(pid_t pid);

}  // namespace window_test
