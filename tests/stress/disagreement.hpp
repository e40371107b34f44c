// A pixel that two see differently, as small as it can be shown.
#pragma once

#include <string>

#include "cases.hpp"
#include "oracle/minimise.hpp"

namespace stress {

/// The smallest scene that still `shows` it (see oracle::minimise), and the view and the pixel, for
/// a regression test and for OpenSCAD.
std::string minimised(const Scene& scene, const View& view, size_t pixel,
                      const oracle::Shows& shows, uint32_t most_tries = oracle::kMostTries);

}  // namespace stress
