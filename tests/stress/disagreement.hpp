// Reports a pixel on which two renderers disagree, in the smallest scene that shows it.
#pragma once

#include <string>

#include "cases.hpp"
#include "oracle/minimise.hpp"

namespace stress {

/// Returns the smallest scene that still `shows` the disagreement (see oracle::minimise), with the
/// view and the pixel, for a regression test and for OpenSCAD.
std::string minimised(const Scene& scene, const View& view, size_t pixel,
                      const oracle::Shows& shows, uint32_t most_tries = oracle::kMostTries);

}  // namespace stress
