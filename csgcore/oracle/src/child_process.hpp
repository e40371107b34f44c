// Work that cannot be interrupted, in a process that can be killed.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "oracle/nef_solid.hpp"

namespace oracle {

struct ChildOutput {
  NefStatus status;
  std::string text;  // what the work wrote if it was done, or why it failed
};

/// Runs `work` in a copy of this process. An exception or a crash of it is kFailed. The copy has no
/// threads but the caller's: work must not need others, nor locks that others may hold. A
/// sanitizer's allocator has one (up to GCC 13), so other threads had better be idle.
ChildOutput run_in_child(const std::function<void(std::ostream&)>& work, const NefLimits& limits);

}  // namespace oracle
