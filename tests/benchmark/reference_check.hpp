// Compares a picture's hits with the tests' reference.
#pragma once

#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace frame_benchmark {

/// Returns whether some hundred pixels show what the reference does, unless that is undecided.
bool agrees_with_reference(const csgcore::Scene& scene, const csgcore::View& view,
                           const csgcore::Hits& hits);

}  // namespace frame_benchmark
