// An evaluation of trees that shares nothing with csgcore's or its oracles'.
#pragma once

#include <functional>
#include <span>

#include "csgcore/csg_tree.hpp"

namespace test_support {

/// The value of a tree in postfix order where `inside` tells what each primitive holds.
bool evaluate_tree(std::span<const csgcore::CsgToken> tokens,
                   const std::function<bool(uint32_t)>& inside);

}  // namespace test_support
