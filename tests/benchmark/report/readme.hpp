// Replaces the part of the repository's README.md that a program writes.
#pragma once

#include <string>

namespace report {

inline constexpr char kRegionStart[] = "<!-- benchmarks: written by tests/benchmark/run -->";
inline constexpr char kRegionEnd[] = "<!-- end of benchmarks -->";

/// Returns the text with the part between the two marks replaced, and nothing else. Throws
/// std::runtime_error unless each mark is there once, in this order.
std::string with_region(const std::string& readme, const std::string& region);

}  // namespace report
