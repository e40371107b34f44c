// Repeated measurements of the same work, and what they come to.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bench/samples.hpp"

namespace measure {

// As `scadray bench` has them; every time in the results is a Summary.
using bench::Repetitions;
using bench::summarise;
using bench::Summary;

/// Work that takes its own time: returns ms.
using Timed = std::function<double()>;
/// Any work, timed by the clock on the wall.
Timed timed(std::function<void()> work);

/// Measures all of them in turn, one of each a round, so that what else the machine does meets all
/// alike. The first round warms up and does not count.
std::vector<Summary> measure_in_turn(std::span<const Timed> works, const Repetitions& repetitions);
Summary measure(const Timed& work, const Repetitions& repetitions);

}  // namespace measure
