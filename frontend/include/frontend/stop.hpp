// Stops work from another thread, by a std::stop_token.
#pragma once

#include <stop_token>

#include "csgcore/stop_scope.hpp"

namespace frontend {

using csgcore::Stopped;

inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped{};
}

}  // namespace frontend
