// Runs what may recurse deeply.
#pragma once

#include <functional>

namespace language {

/// Calls `work` on a stack that holds some 20,000 nested symbols of a design, whatever the stack
/// of the caller; within another such call on that call's. Returns when it has ended, and throws
/// what it throws.
void with_deep_stack(const std::function<void()>& work);

}  // namespace language
