// The part of the repository's README.md that is written by a program.
#pragma once

#include <string>

namespace report {

inline constexpr char kRegionStart[] = "<!-- benchmarks: written by tests/benchmark/run -->";
inline constexpr char kRegionEnd[] = "<!-- end of benchmarks -->";

/// The text with what stands between the two marks replaced, and nothing else. Throws
/// std::runtime_error if not each of them stands there once, in this order.
std::string with_region(const std::string& readme, const std::string& region);

}  // namespace report
