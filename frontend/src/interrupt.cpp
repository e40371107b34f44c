#include "frontend/interrupt.hpp"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>

#include "frontend/error.hpp"
#include "frontend/options.hpp"

namespace frontend {
namespace {

// A handler may run on any thread, between any two instructions: it may only look at lock-free
// atomics, and call what POSIX lists as async-signal-safe.
constexpr std::size_t kSlots = kMaxPictures + 2;  // the pictures, statistics, rule
std::array<std::atomic<const char*>, kSlots> files_to_remove;
std::atomic<pid_t> child_group{0};
static_assert(std::atomic<const char*>::is_always_lock_free);
static_assert(std::atomic<pid_t>::is_always_lock_free);

/// For a child that another thread is just starting, in ms: long, and yet an end.
constexpr int kMostWaits = 2000;

void on_interrupt(int) {
  pid_t group = child_group.load();
  for (int waits = 0; group == kStartingChild && waits < kMostWaits; ++waits) {
    poll(nullptr, 0, 1);
    group = child_group.load();
  }
  if (group > 0) kill(-group, SIGKILL);
  for (std::atomic<const char*>& slot : files_to_remove) {
    if (const char* path = slot.exchange(nullptr)) unlink(path);
  }
  constexpr char kText[] = "error: interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(1);
}

void handle(int signal_number) {
  struct sigaction action {};
  if (sigaction(signal_number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = on_interrupt;
  sigfillset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

void handle_interrupts() {
  handle(SIGINT);
  handle(SIGTERM);
  handle(SIGHUP);
  signal(SIGPIPE, SIG_IGN);
}

RemoveOnInterrupt::RemoveOnInterrupt(const char* path) : slot_(0) {
  for (; slot_ < kSlots; ++slot_) {
    const char* none = nullptr;
    if (files_to_remove[slot_].compare_exchange_strong(none, path)) return;
  }
  throw Error("", {}, "too many output files at once", "write fewer");
}

RemoveOnInterrupt::~RemoveOnInterrupt() { files_to_remove[slot_].store(nullptr); }

void set_child_group(pid_t group) { child_group.store(group); }

}  // namespace frontend
