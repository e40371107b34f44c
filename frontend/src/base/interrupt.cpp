#include "frontend/interrupt.hpp"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <string_view>

#include "frontend/error.hpp"

namespace frontend {
namespace {

// A handler may run on any thread, between any two instructions. So it may only use lock-free
// atomics, and call only what POSIX lists as async-signal-safe.
std::array<std::atomic<const char*>, kMaxRemovedFiles> files_to_remove;
std::array<std::atomic<pid_t>, kMaxChildGroups> child_groups;
/// In `child_groups`: the place is taken, but has no group now. A free place has 0.
constexpr pid_t kNoGroup = -1;
std::atomic<int> holders{0};  // HoldInterrupts that exist now
static_assert(std::atomic<const char*>::is_always_lock_free);
static_assert(std::atomic<pid_t>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free);

/// The longest wait for another thread's HoldInterrupts, in ms.
constexpr int kMostWaits = 5000;

/// Signals that end a program by default. Nothing but their number shows why it was interrupted.
constexpr int kInterruptions[] = {SIGINT,  SIGTERM, SIGHUP,  SIGALRM, SIGVTALRM, SIGPROF,
                                  SIGUSR1, SIGUSR2, SIGPOLL, SIGPWR,  SIGSTKFLT, SIGXCPU};
/// Signals that dump core by default, which must still happen.
constexpr int kCrashes[] = {SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGSYS, SIGTRAP};

void clean_up() {
  for (const std::atomic<pid_t>& slot : child_groups) {
    if (const pid_t group = slot.load(); group > 0) kill(-group, SIGKILL);
  }
  for (std::atomic<const char*>& slot : files_to_remove) {
    if (const char* path = slot.exchange(nullptr)) unlink(path);
  }
}

void on_interrupt(int signal_number) {
  for (int waits = 0; holders.load() > 0 && waits < kMostWaits; ++waits) poll(nullptr, 0, 1);
  clean_up();
  const std::string_view text =
      signal_number == SIGXCPU
          ? "error: the limit on processor time is reached (raise it, by ulimit -t)\n"
          : "error: interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
  _exit(1);
}

void on_crash(int signal_number) {
  clean_up();
  signal(signal_number, SIG_DFL);
  raise(signal_number);  // raised when the handler returns: until then the signal is blocked
}

/// Installs the handler, except for signals that the caller ignores, or that a sanitizer or
/// profiler handles already.
void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  if (sigaction(signal_number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  action = {};
  action.sa_handler = handler;
  sigfillset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

void handle_interrupts() {
  for (const int number : kInterruptions) handle(number, on_interrupt);
  for (int number = SIGRTMIN; number <= SIGRTMAX; ++number) handle(number, on_interrupt);
  for (const int number : kCrashes) handle(number, on_crash);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

RemoveOnInterrupt::RemoveOnInterrupt(const char* path) : slot_(0) {
  for (; slot_ < kMaxRemovedFiles; ++slot_) {
    const char* none = nullptr;
    if (files_to_remove[slot_].compare_exchange_strong(none, path)) return;
  }
  throw Error("", {}, "too many output files at once", "write fewer");
}

RemoveOnInterrupt::~RemoveOnInterrupt() { files_to_remove[slot_].store(nullptr); }

KillOnInterrupt::KillOnInterrupt() : slot_(0) {
  for (; slot_ < kMaxChildGroups; ++slot_) {
    pid_t none = 0;
    if (child_groups[slot_].compare_exchange_strong(none, kNoGroup)) return;
  }
  throw Error("", {}, "too many programs at once", "start fewer");
}

KillOnInterrupt::~KillOnInterrupt() { child_groups[slot_].store(0); }

void KillOnInterrupt::set(pid_t group) { child_groups[slot_].store(group > 0 ? group : kNoGroup); }

HoldInterrupts::HoldInterrupts() {
  // The signals are blocked first: a handler on this thread would wait for itself.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before_);
  ++holders;
}

HoldInterrupts::~HoldInterrupts() {
  --holders;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace frontend
