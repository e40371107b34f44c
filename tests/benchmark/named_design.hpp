// Designs by the names that benchmarks have.
#pragma once

#include <string>

#include "csgcore/scene.hpp"

namespace frame_benchmark {

struct Design {
  csgcore::Scene scene;
  csgcore::Box view_box;
};

/// CSn or CCn, in memory; or an example's. Gives up where that cannot be read.
Design make_design(const std::string& name);

}  // namespace frame_benchmark
