#include "base/simd.hpp"

#include <algorithm>
#include <atomic>

namespace csgcore {
namespace {

/// Whether all levels are compiled (CSGCORE_DISABLED_TARGETS).
#ifdef CSGCORE_TWO_TARGETS
constexpr bool kCompilesAll = false;
#else
constexpr bool kCompilesAll = true;
#endif

/// Asks for the features that Highway compiles its targets for (its set_macros-inl.h), except F16C:
/// clang 14 cannot ask for it, and every processor with AVX2 has it.
SimdLevel widest_supported() {
#if defined(__x86_64__) || defined(__i386__)
  const bool sse4 = __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") &&
                    __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw");
  if (kCompilesAll && avx512) return SimdLevel::kAvx512;
  if (avx2) return SimdLevel::kAvx2;
  if (kCompilesAll && sse4) return SimdLevel::kSse4;
#endif
  return SimdLevel::kBaseline;
}

std::atomic<SimdLevel>& current() {
  static std::atomic<SimdLevel> level{widest_supported()};
  return level;
}

}  // namespace

SimdLevel simd_level() { return current().load(std::memory_order_relaxed); }

void limit_simd_level(SimdLevel widest) {
  const SimdLevel supported = widest_supported();
  const bool is_left_out = !kCompilesAll && widest == SimdLevel::kSse4;
  current() = std::max(is_left_out ? SimdLevel::kBaseline : widest, supported);
}

}  // namespace csgcore
