// The CPU tracer with every technique.
#pragma once

#include "suite.hpp"

namespace stress {

/// Returns the methods: by screen tiles, by kd-trees of several leaf sizes, and by the paper's own
/// rule.
std::vector<Method> cpu_methods();

/// Finds a method by its name.
Method cpu_method(const std::string& name);

}  // namespace stress
