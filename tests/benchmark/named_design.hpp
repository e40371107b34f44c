// Finds designs by the names that benchmarks have.
#pragma once

#include <string>

#include "csgcore/scene.hpp"

namespace frame_benchmark {

struct Design {
  csgcore::Scene scene;
  csgcore::Box view_box;
};

/// Makes CSn or CCn in memory, or reads an example. Gives up if it cannot be read.
Design make_design(const std::string& name);

}  // namespace frame_benchmark
