// Repeated measurements of the same work, and their summary.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bench/samples.hpp"

namespace measure {

// The types of `scadray bench`; every time in the results is a Summary.
using bench::Repetitions;
using bench::summarise;
using bench::Summary;

/// Work that measures its own time, and returns it in ms.
using Timed = std::function<double()>;
/// Returns work that is timed by the wall clock.
Timed timed(std::function<void()> work);

/// Measures all works in turn, one of each a round, so that other load on the machine affects all
/// alike. The first round warms up and does not count.
std::vector<Summary> measure_in_turn(std::span<const Timed> works, const Repetitions& repetitions);
Summary measure(const Timed& work, const Repetitions& repetitions);

}  // namespace measure
