// The CPU tracer, by every way of finding what a ray can meet.
#pragma once

#include "suite.hpp"

namespace stress {

/// By screen tiles, by kd-trees of several leaf sizes, and by the paper's own rule.
std::vector<Method> cpu_methods();

/// By the name of a method.
Method cpu_method(const std::string& name);

}  // namespace stress
