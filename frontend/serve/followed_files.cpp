#include "followed_files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/descriptor.hpp"
#include "follow/file_watch.hpp"
#include "language/file_signature.hpp"

namespace serve {
namespace {

using frontend::FileWatch;
using Clock = FileWatch::Clock;

/// How often files are looked at that the system cannot watch.
constexpr std::chrono::milliseconds kPollInterval{250};

}  // namespace

class FollowedFiles::Watch {
 public:
  explicit Watch(std::function<void()> on_change)
      : on_change_(std::move(on_change)),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  ~Watch() {
    thread_.request_stop();
    wake_.raise();
    thread_.join();
  }

  void set(const std::vector<std::string>& read, const std::vector<std::string>& missing) {
    {
      const std::lock_guard lock(mutex_);
      read_ = {read.begin(), read.end()};
      missing_ = {missing.begin(), missing.end()};
      is_set_ = true;
    }
    wake_.raise();
  }

  void note_reading() {
    const std::lock_guard lock(mutex_);
    reading_since_ns_ = FileWatch::system_time_ns();
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const bool is_gone = take_paths();
      watch_.update();
      const auto settled = watch_.settled_at();
      const bool has_changed = is_gone || (settled && Clock::now() >= *settled);
      if (!has_changed || stop.stop_requested()) continue;
      watch_.forget_changes();
      on_change_();
    }
  }

  /// Watches what was set. Returns whether a file was read that is gone already.
  bool take_paths() {
    std::set<std::string> read, all;
    int64_t since_ns = 0;
    {
      const std::lock_guard lock(mutex_);
      if (!std::exchange(is_set_, false)) return false;
      read = read_;
      all = missing_;
      since_ns = reading_since_ns_;
    }
    all.insert(read.begin(), read.end());
    watch_.set_files({all.begin(), all.end()}, since_ns);
    const std::set<std::string> before = std::exchange(watched_, read);
    return std::ranges::any_of(read, [&](const std::string& path) {
      return !before.contains(path) && !language::FileSignature(path).exists();
    });
  }

  /// Waits until there may be something to do.
  void wait() {
    std::optional<Clock::time_point> until = watch_.next_look();
    if (const auto settled = watch_.settled_at())
      until = until ? std::min(*until, *settled) : settled;
    frontend::wait_for_news(watch_, wake_, until);
  }

  const std::function<void()> on_change_;
  frontend::Event wake_;
  std::mutex mutex_;                      // of the following
  std::set<std::string> read_, missing_;  // that are to be watched from now on
  bool is_set_ = false;                   // they have been set, and not been taken
  int64_t reading_since_ns_ = 0;
  std::set<std::string> watched_;          // files that were read; used by the thread alone
  FileWatch watch_{false, kPollInterval};  // the same
  std::jthread thread_;                    // the last member: it uses the others
};

FollowedFiles::FollowedFiles(std::function<void()> on_change)
    : watch_(std::make_unique<Watch>(std::move(on_change))) {}
FollowedFiles::~FollowedFiles() = default;

void FollowedFiles::set(const std::vector<std::string>& read,
                        const std::vector<std::string>& missing) {
  watch_->set(read, missing);
}
void FollowedFiles::note_reading() { watch_->note_reading(); }

}  // namespace serve
