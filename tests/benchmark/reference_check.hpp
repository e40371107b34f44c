// A picture's hits, held against the tests' reference.
#pragma once

#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace frame_benchmark {

/// At some hundred pixels: what the reference knows to be so is so.
bool agrees_with_reference(const csgcore::Scene& scene, const csgcore::View& view,
                           const csgcore::Hits& hits);

}  // namespace frame_benchmark
