// File descriptors with an owner.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <stop_token>
#include <system_error>
#include <utility>

namespace frontend {

/// Closes the descriptor that it owns. A negative number means that it owns none.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void reset(int number) {
    if (number_ >= 0) close(number_);
    number_ = number;
  }
  /// Closes the descriptor. Returns false if the system reports only now that a write failed.
  bool close_now() {
    const int result = close(std::exchange(number_, -1));
    return result == 0;
  }

 private:
  int number_;
};

/// A flag that a thread can wait for by poll, among other descriptors: it is readable while raised.
class Event {
 public:
  Event() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (event_.number() < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  }
  int descriptor() const { return event_.number(); }
  void raise() const { eventfd_write(event_.number(), 1); }
  void clear() const {
    eventfd_t count;
    eventfd_read(event_.number(), &count);
  }

 private:
  Descriptor event_;
};

/// Raises an event when a stop_token's stop is requested.
class StopEvent {
 public:
  explicit StopEvent(std::stop_token stop) : callback_(std::move(stop), Raise{event_}) {}
  StopEvent(const StopEvent&) = delete;
  StopEvent& operator=(const StopEvent&) = delete;
  int descriptor() const { return event_.descriptor(); }

 private:
  struct Raise {
    const Event& event;
    void operator()() const { event.raise(); }
  };
  Event event_;  // declared before the callback that raises it
  std::stop_callback<Raise> callback_;
};

}  // namespace frontend
