// Stops work from another thread, by a std::stop_token.
#pragma once

#include <stop_token>

namespace frontend {

/// Thrown by work that was asked to stop. It is not an error.
struct Stopped {};

inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped{};
}

}  // namespace frontend
