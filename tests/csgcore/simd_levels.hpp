// Runs a test with every instruction set of this machine.
#pragma once

#include "base/simd.hpp"

namespace csgcore::checks {

inline const char* name_of(SimdLevel level) {
  constexpr const char* kNames[] = {"AVX-512", "AVX2", "SSE4", "baseline"};
  return kNames[static_cast<int>(level)];
}

/// Calls visit(level) for each level that the machine has, the widest first, while that level is in
/// use.
template <typename Visit>
void for_each_simd_level(Visit&& visit) {
  struct Restorer {
    ~Restorer() { limit_simd_level(SimdLevel::kAvx512); }
  } restorer;
  for (int i = 0; i <= static_cast<int>(SimdLevel::kBaseline); ++i) {
    const SimdLevel level = static_cast<SimdLevel>(i);
    limit_simd_level(level);
    if (simd_level() == level) visit(level);
  }
}

}  // namespace csgcore::checks
