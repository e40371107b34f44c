// The designs to start from: kinds of designs that renderers find hard.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "random.hpp"

namespace slow_search {

struct Family {
  const char* name;
  /// Makes about `count` primitives, as .csg text.
  std::string (*make)(Random& random, int count);
};

const std::vector<Family>& families();

}  // namespace slow_search
