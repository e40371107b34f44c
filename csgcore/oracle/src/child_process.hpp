// Runs work that cannot be interrupted in a process that can be killed.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "oracle/nef_solid.hpp"

namespace oracle {

struct ChildOutput {
  NefStatus status;
  std::string text;  // the output of the work, or the reason of its failure
};

/// Runs `work` in a copy of this process. An exception or a crash gives kFailed. The copy has the
/// caller's thread only, so that `work` must not need other threads, nor locks that other threads
/// may hold. A sanitizer's allocator has such a lock (up to GCC 13), so that other threads should
/// be idle.
ChildOutput run_in_child(const std::function<void(std::ostream&)>& work, const NefLimits& limits);

}  // namespace oracle
