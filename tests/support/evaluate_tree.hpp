// Evaluates trees by code that shares nothing with csgcore or its oracles.
#pragma once

#include <functional>
#include <span>

#include "csgcore/csg_tree.hpp"

namespace test_support {

/// Returns the value of a tree in postfix order; `inside` tells whether the point is in a
/// primitive.
bool evaluate_tree(std::span<const csgcore::CsgToken> tokens,
                   const std::function<bool(uint32_t)>& inside);

}  // namespace test_support
