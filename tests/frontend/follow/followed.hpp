// Follows a design in a test, and waits for its versions.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontend/design_follower.hpp"

namespace frontend {

/// Far longer than anything that tests wait for, on a slow machine and under a sanitizer.
constexpr std::chrono::seconds kPatience{60};

/// Follows by inotify, without looking at the files at short intervals.
inline FollowOptions by_inotify() {
  FollowOptions options;
  options.evaluator = Evaluator::kOpenScad;
  options.poll_interval = std::chrono::hours(1);
  return options;
}

/// Follows without inotify.
inline FollowOptions by_polling() {
  FollowOptions options;
  options.evaluator = Evaluator::kOpenScad;
  options.polls = true;
  options.poll_interval = std::chrono::milliseconds(2);
  return options;
}

class Followed {
 public:
  explicit Followed(const std::string& path, FollowOptions options = by_inotify())
      : follower_(std::in_place, path, std::move(options), [this] {
          const std::lock_guard lock(mutex_);
          ++news_;
          changed_.notify_all();
        }) {}

  DesignFollower& operator*() { return *follower_; }
  DesignFollower* operator->() { return &*follower_; }
  void end() { follower_.reset(); }

  /// Returns the next version for which `is_wanted` holds; earlier ones are kept in passed().
  DesignVersion next(const std::function<bool(const DesignVersion&)>& is_wanted) {
    std::optional<DesignVersion> found;
    wait([&] {
      while (std::optional<DesignVersion> version = follower_->take()) {
        if (is_wanted(*version)) {
          found = std::move(version);
          return true;
        }
        passed_.push_back(std::move(*version));
      }
      return false;
    });
    if (found) return *found;
    ADD_FAILURE() << "no such version" << (passed_.empty() ? "" : "; the last: " + last_text());
    return {};
  }
  DesignVersion next() {
    return next([](const DesignVersion&) { return true; });
  }
  /// Returns the next version with so many primitives.
  DesignVersion next_of(uint32_t primitives) {
    return next([primitives](const DesignVersion& version) {
      return version.design && version.design->primitive_nodes == primitives;
    });
  }
  DesignVersion next_error() {
    return next([](const DesignVersion& version) { return !version.error.empty(); });
  }
  void wait_until_idle() {
    wait([&] { return follower_->state() == DesignFollower::State::kIdle; });
  }
  const std::vector<DesignVersion>& passed() const { return passed_; }

 private:
  void wait(const std::function<bool()>& is_done) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    std::unique_lock lock(mutex_);
    while (true) {
      const int seen = news_;
      lock.unlock();
      if (is_done()) return;
      lock.lock();
      if (!changed_.wait_until(lock, end, [&] { return news_ != seen; })) break;
    }
    ADD_FAILURE() << "nothing for too long";
  }
  std::string last_text() const {
    const DesignVersion& last = passed_.back();
    return last.design ? std::to_string(last.design->primitive_nodes) + " primitives" : last.error;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  int news_ = 0;
  std::vector<DesignVersion> passed_;
  std::optional<DesignFollower> follower_;  // declared last, since it calls back
};

/// Returns a .csg of `count` primitives.
inline std::string spheres(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n";
  return text;
}

}  // namespace frontend
